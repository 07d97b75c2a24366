// What the benchmark programs share: arguments, the clock, passes.
//
// PROGRAM SECONDS FILE... spends SECONDS of CPU time on each number of each model. A FILE is URDF;
// "floating:" before it gives it a free base; "@0.1" after it moves every coordinate by 0.1, and
// "@0.1,0.2" also every joint's velocity, where there is motion, to 0.2. Each model gives one JSON
// object, on its own line. Times are of this thread's CPU clock, [us] a call.
#pragma once

#include <algorithm>
#include <ctime>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace saltus::bench {

constexpr int passes = 7;

struct Job {
  std::string file;
  bool floating = false;
  double angle = 0;  ///< [rad | m]
  double rate = 0;   ///< [rad/s | m/s] of the joints; a free base is at rest
};

struct Time {
  double least = 0, median = 0;  ///< [us] a call, of the passes
};

inline std::ostream& operator<<(std::ostream& out, const Time& t) {
  return out << "{\"min\": " << t.least << ", \"median\": " << t.median << "}";
}

inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

inline Time summary(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  return {1e6 * seconds.front(), 1e6 * seconds[seconds.size() / 2]};
}

inline double seconds_of(int calls, const std::function<void()>& work) {
  const double start = cpu_seconds();
  for (int i = 0; i < calls; ++i) work();
  return cpu_seconds() - start;
}

/// Calls `work` for about `budget` seconds in passes of equal length.
inline Time time_of(double budget, const std::function<void()>& work) {
  work();
  int calls = 1;  // how many fill a pass
  while (calls < 1 << 24 && seconds_of(calls, work) < budget / passes / 2) calls *= 2;
  std::vector<double> seconds;
  for (int i = 0; i < passes; ++i) seconds.push_back(seconds_of(calls, work) / calls);
  return summary(seconds);
}

inline Job job(std::string text) {
  Job out;
  if (text.rfind("floating:", 0) == 0) {
    out.floating = true;
    text.erase(0, 9);
  }
  if (const auto at = text.rfind('@'); at != std::string::npos) {
    const std::string numbers = text.substr(at + 1);
    out.angle = std::stod(numbers);
    if (const auto comma = numbers.find(','); comma != std::string::npos) {
      out.rate = std::stod(numbers.substr(comma + 1));
    }
    text.erase(at);
  }
  out.file = text;
  return out;
}

inline int main(int argc, char** argv, const std::function<void(double, const Job&)>& run) {
  if (argc < 3) {
    std::cerr << argv[0] << " SECONDS [floating:]FILE[@ANGLE[,RATE]]...\n";
    return 2;
  }
  try {
    for (int i = 2; i < argc; ++i) run(std::stod(argv[1]), job(argv[i]));
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}

}  // namespace saltus::bench
