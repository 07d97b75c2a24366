// Counts the heap allocations of a test program, the library's and Eigen's included. It replaces
// the global malloc: include it in exactly one file of a program.
#pragma once

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <new>

namespace saltus::test {
inline std::atomic<long> allocations{0};
}

// Eigen's arrays come from malloc, not from operator new, so that replacing the latter would miss
// them. Where malloc cannot be replaced (another C library, a sanitizer that has its own),
// operator new is what is left.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
// glibc's own, under their second names; aligned types and vectors of them come from memalign.
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_memalign(std::size_t alignment, std::size_t size);
extern "C" void* malloc(std::size_t size) noexcept {
  ++saltus::test::allocations;
  return __libc_malloc(size);
}
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++saltus::test::allocations;
  return __libc_memalign(alignment, size);
}
extern "C" int posix_memalign(void** p, std::size_t alignment, std::size_t size) noexcept {
  ++saltus::test::allocations;
  *p = __libc_memalign(alignment, size);
  return *p == nullptr ? ENOMEM : 0;
}
#else
void* operator new(std::size_t size) {
  ++saltus::test::allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
#endif
