// Coefficients of a turn as power series of x = t^2, exact to rounding below t = 0.3: branch-free,
// for loops over lanes too. rotation.hpp has what they are.
#pragma once

#include <array>
#include <cstddef>

namespace saltus::turn_series {

inline constexpr double small = 0.09;  ///< x below which they are summed

/// sum of k[i] x^i.
template <std::size_t N>
constexpr double sum(const std::array<double, N>& k, double x) {
  double out = k[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) out = out * x + k[i];
  return out;
}

// b = sum (-x)^k / (2k + 2)!, c = sum (-x)^k / (2k + 3)!, their derivatives by t over t.
inline constexpr std::array b = {1. / 2,      -1. / 24,     1. / 720,
                                 -1. / 40320, 1. / 3628800, -1. / 479001600};
inline constexpr std::array c = {1. / 6,       -1. / 120,     1. / 5040,
                                 -1. / 362880, 1. / 39916800, -1. / 6227020800};
inline constexpr std::array b1 = {-2. / 24, 4. / 720, -6. / 40320, 8. / 3628800, -10. / 479001600};
inline constexpr std::array c1 = {-2. / 120, 4. / 5040, -6. / 362880, 8. / 39916800,
                                  -10. / 6227020800};
// sin(t/2) / t and cos(t/2).
inline constexpr std::array sine = {1. / 2,       -1. / 48,       1. / 3840,
                                    -1. / 645120, 1. / 185794560, -1. / 81749606400};
inline constexpr std::array cosine = {
    1., -1. / 8, 1. / 384, -1. / 46080, 1. / 10321920, -1. / 3715891200, 1. / 1961990553600};
// ((t/2) / sin(t/2) - 1) / x and tan(t/4) / t.
inline constexpr std::array arc1 = {1. / 24,          7. / 5760,
                                    31. / 967680,     127. / 154828800,
                                    73. / 3503554560, 1414477. / 2678117105664000};
inline constexpr std::array arc2 = {1. / 4,        1. / 192,        1. / 7680,
                                    17. / 5160960, 31. / 371589120, 691. / 326998425600};

}  // namespace saltus::turn_series
