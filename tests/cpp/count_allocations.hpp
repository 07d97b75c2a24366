// Counts the heap allocations of a test program, the library's included. It replaces the global
// operator new: include it in exactly one file of a program.
#pragma once

#include <atomic>
#include <cstdlib>
#include <new>

namespace saltus::test {
inline std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
  ++saltus::test::allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
