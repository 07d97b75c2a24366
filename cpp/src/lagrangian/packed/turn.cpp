// Sines and cosines in lanes.
//
//   x = k pi/2 + r, |r| <= pi/4; sin and cos of r by polynomials; k tells which of them, and signs
//
// pi/2 in parts of 33, 33 and 53 bits: products of the first two with k < 2^20 are exact (Cody &
// Waite). The minimax polynomials are those of fdlibm (k_sin.c, k_cos.c; Sun Microsystems, 1993).
// Errors are of about an ulp. No library that we may ask for has this in double precision for every
// machine.
#include "lagrangian/packed/turn.hpp"

#include <bit>
#include <cstdint>

#include "lagrangian/packed/lane.hpp"

namespace saltus::packed {
namespace {

// Beyond, angles go to libm one by one: k would outgrow the parts of pi/2.
constexpr double largest = 1e5;

SALTUS_INLINE double sine_polynomial(double r) {
  const double z = r * r;
  const double p =
      -1.66666666666666324348e-01 +
      z * (8.33333333332248946124e-03 +
           z * (-1.98412698298579493134e-04 +
                z * (2.75573137070700676789e-06 +
                     z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10))));
  return r + r * z * p;
}

SALTUS_INLINE double cosine_polynomial(double r) {
  const double z = r * r;
  const double p =
      4.16666666666666019037e-02 +
      z * (-1.38888888888741095749e-03 +
           z * (2.48015872894767294178e-05 +
                z * (-2.75573143513906633035e-07 +
                     z * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11))));
  const double half = z / 2, w = 1 - half;
  return w + ((1 - w - half) + z * z * p);
}

SALTUS_INLINE void turn_lane(double x, double& cosine, double& sine) {
  constexpr double magic = 0x1.8p52;  // adding it rounds to an integer, in the low bits
  const double shifted = x * 6.36619772367581382433e-01 + magic;
  const std::uint64_t k = std::bit_cast<std::uint64_t>(shifted);
  const double turns = shifted - magic;
  const double r = ((x - turns * 1.57079632673412561417e+00) - turns * 6.07710050630396597660e-11) -
                   turns * 2.02226624879595063154e-21;
  const double s = sine_polynomial(r), c = cosine_polynomial(r);
  const double sine_size = k & 1 ? c : s, cosine_size = k & 1 ? s : c;
  sine = k & 2 ? -sine_size : sine_size;
  cosine = (k + 1) & 2 ? -cosine_size : cosine_size;
}

}  // namespace

SALTUS_CLONES void set_turns(const PackedTree& t, Packed& w) {
  for (int b = 0; b < t.slots / lanes; ++b) {
    const double *kind = t.kind[b].x[0], *s = w.s[b].x[0];
    double* turn = w.turn[b].x[0];
    bool near = true;
    for (int l = 0; l < lanes; ++l) near = near && std::abs(s[l]) <= largest;
    if (near) {
      SALTUS_LANES
      for (int l = 0; l < lanes; ++l) turn_lane(kind[l] * s[l], turn[l], turn[lanes + l]);
    } else {
      for (int l = 0; l < lanes; ++l) {
        turn[l] = std::cos(kind[l] * s[l]);
        turn[lanes + l] = std::sin(kind[l] * s[l]);
      }
    }
  }
}

}  // namespace saltus::packed
