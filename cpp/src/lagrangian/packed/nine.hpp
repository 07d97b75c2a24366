// Rows of nine numbers in three wide registers; the last three of twelve are zero.
#pragma once

#include <cstring>

#include "lagrangian/packed/lane.hpp"

namespace saltus::packed {

using Four [[gnu::vector_size(32)]] = double;

SALTUS_INLINE Four load4(const double* x) {
  Four out;
  std::memcpy(&out, x, sizeof out);
  return out;
}
SALTUS_INLINE void save4(Four from, double* x) { std::memcpy(x, &from, sizeof from); }

struct Nine {
  Four a, b, c;
};

SALTUS_INLINE Nine zero() { return {Four{}, Four{}, Four{}}; }

SALTUS_INLINE double dot(const Nine& x, const Nine& y) {
  const Four sum = x.a * y.a + x.b * y.b + x.c * y.c;
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

/// to += factor * from.
SALTUS_INLINE void add(double factor, const Nine& from, Nine& to) {
  to.a += factor * from.a;
  to.b += factor * from.b;
  to.c += factor * from.c;
}

/// Numbers c ... c + 8 of a slot.
SALTUS_INLINE Nine unpack(const double* x, int c) {
  x += c * lanes;
  const double last = x[8 * lanes];
  // a product, not {last, 0, 0, 0}: valgrind 3.19 does not know the instruction that makes that
  return {Four{x[0], x[lanes], x[2 * lanes], x[3 * lanes]},
          Four{x[4 * lanes], x[5 * lanes], x[6 * lanes], x[7 * lanes]},
          Four{last, last, last, last} * Four{1, 0, 0, 0}};
}

}  // namespace saltus::packed
