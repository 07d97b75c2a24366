// What this machine can do at most, on one thread: fused multiply-adds, and memory traffic.
//
// bench_peaks SECONDS prints one JSON object: GFlop/s of doubles, GB/s of copy and triad. The clock
// is that of clock.hpp, each figure the best of its passes.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "clock.hpp"

// A loop is compiled for each of these sets of instructions; the machine's best one runs.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__)
#define SALTUS_BENCH_CLONES __attribute__((target_clones("avx512f", "fma", "default")))
#else
#define SALTUS_BENCH_CLONES
#endif

namespace {

using saltus::bench::cpu_seconds;
using saltus::bench::passes;

constexpr int rounds = 200'000;  // a call takes a millisecond, far above what a clock may be off

// Independent sums must outnumber an FMA unit's latency (4 cycles) times two units, in vectors, and
// fit into the registers: 12 of 8 lanes, or 12 of 4.
constexpr int sums_of_8 = 96, sums_of_4 = 48;

template <int sums>
[[gnu::always_inline]] inline void multiply_add(double* x, double factor, double term) {
  double s[sums];
  for (int i = 0; i < sums; ++i) s[i] = x[i];
  for (int round = 0; round < rounds; ++round) {
    for (int i = 0; i < sums; ++i) s[i] = s[i] * factor + term;
  }
  for (int i = 0; i < sums; ++i) x[i] = s[i];
}

SALTUS_BENCH_CLONES void multiply_add_of_8(double* x, double factor, double term) {
  multiply_add<sums_of_8>(x, factor, term);
}

SALTUS_BENCH_CLONES void multiply_add_of_4(double* x, double factor, double term) {
  multiply_add<sums_of_4>(x, factor, term);
}

SALTUS_BENCH_CLONES void copy(double* a, const double* b, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] = b[i];
}

SALTUS_BENCH_CLONES void triad(double* a, const double* b, const double* c, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3.0 * c[i];
}

/// Seconds of the fastest of many calls that fill `budget` seconds.
template <class Work>
double fastest(double budget, const Work& work) {
  double least = HUGE_VAL;
  const double end = cpu_seconds() + budget;
  for (int pass = 0; pass < passes || cpu_seconds() < end; ++pass) {
    const double start = cpu_seconds();
    work();
    least = std::min(least, cpu_seconds() - start);
  }
  return least;
}

void run(double budget) {
  std::vector<double> x(sums_of_8, 1.0);
  const double of_8 = fastest(budget, [&] { multiply_add_of_8(x.data(), 0.999, 1e-3); });
  const double of_4 = fastest(budget, [&] { multiply_add_of_4(x.data(), 0.999, 1e-3); });
  const double fma = std::min(of_8 / sums_of_8, of_4 / sums_of_4);
  const std::size_t n = std::size_t{1} << 24;  // 128 MiB an array: larger than caches
  std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
  const double copied = fastest(budget, [&] { copy(a.data(), b.data(), n); });
  const double added = fastest(budget, [&] { triad(a.data(), b.data(), c.data(), n); });
  const double bytes = static_cast<double>(n * sizeof(double));
  std::cout << "{\"fma_gflops\": " << 2e-9 * rounds / fma
            << ", \"copy_gbs\": " << 2e-9 * bytes / copied
            << ", \"triad_gbs\": " << 3e-9 * bytes / added << "}" << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << argv[0] << " SECONDS\n";
    return 2;
  }
  run(std::atof(argv[1]));
  return 0;
}
