// What a second thread is worth on this machine, now: bench_scaling SECONDS THREADS
//
// Every thread counts how often it can do a block of multiply-adds, in registers, while the wall
// clock runs. Prints one JSON object: multiply-adds a second of all threads together.
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>
#include <vector>

namespace {

constexpr int accumulators = 8;   // independent, so that the latency of one hides behind the others
constexpr int block = 1'000'000;  // multiply-adds between looks at the flag

/// Returns blocks done; `sum` is what keeps the compiler from leaving the work out.
long count_blocks(const std::atomic<bool>& stop, double& sum) {
  std::array<double, accumulators> x{};
  long blocks = 0;
  for (; !stop.load(std::memory_order_relaxed); ++blocks) {
    for (int k = 0; k < block / accumulators; ++k) {
      for (double& each : x) each = each * 0.999999 + 1e-6;
    }
  }
  for (const double each : x) sum += each;
  return blocks;
}

double rate(double seconds, int threads) {
  using Clock = std::chrono::steady_clock;
  std::atomic<bool> stop = false;
  std::atomic<long> blocks = 0;
  std::vector<std::thread> crew;
  const auto start = Clock::now();
  for (int i = 0; i < threads; ++i) {
    crew.emplace_back([&] {
      double sum = 0;
      const long own = count_blocks(stop, sum);
      if (sum >= 0) blocks += own;
    });
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  stop = true;
  for (std::thread& thread : crew) thread.join();
  const std::chrono::duration<double> spent = Clock::now() - start;
  return static_cast<double>(blocks) * block / spent.count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << argv[0] << " SECONDS THREADS\n";
    return 2;
  }
  const double per_second = rate(std::atof(argv[1]), std::atoi(argv[2]));
  std::cout << "{\"threads\": " << argv[2] << ", \"multiply_adds\": " << per_second << "}\n";
}
