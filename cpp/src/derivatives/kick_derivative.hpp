// Impulses of contacts at a node, all together and in fixed modes (theory, D6).
//
// p+ = p + sum P_c C_c over the rows C = n, t0, t1 of the contacts, so that with the rates
// u = C M^-1 p+ after it, for each contact,
//
//   normal       u_n = 0; or P_n is given: e times that of the compression before
//   tangential   sticks: u_t = 0; slides: P_t = -mu P_n u_t / |u_t|; along: P_t = mu P_n times a
//                direction that comes with the arc
//
// The rates change by  r = dC v+ + C M^-1 (dp + P dC - L_vq(q, v+) dq),  and by W dP. All equations
// are linear in r, dP and `extra`, what is given: dP = S (X extra - N r), S = (N W + K)^-1.
#pragma once

#include "derivatives/arc_derivative.hpp"
#include "derivatives/frame_derivative.hpp"

namespace saltus {

/// A contact that pushes in a kick.
struct KickContact {
  int joint = -1;  ///< velocity of a joint with dry friction, in place of a pair
  Pair pair;
  FrameChoice frame;
  double friction = 0;
  Vec3 P = Vec3::Zero();  ///< [N s] in the frame
  enum class Mode { frictionless, sticks, slides, along };
  Mode mode = Mode::frictionless;
  bool is_given = false;  ///< its normal impulse
};

struct KickDerivative {
  std::vector<KickContact> contacts;
  std::vector<FrameDerivative> frames;  ///< one a contact
  VecX P;                               ///< (N) all rows that push
  std::vector<int> contact_of, row_of;  ///< (N)
  MatX C;                               ///< (n_v, N)
  MatX of_q, of_p;                      ///< (n_v, N) r by them
  MatX S_X, S_N;                        ///< (N, extra), (N, N)
  MatX direct;                          ///< (n_v, extra) what is given pushes by itself
  VecX v;                               ///< (n_v) after it

  Eigen::Index size() const { return P.size(); }
  /// Numbers that are given.
  Eigen::Index extra() const { return S_X.cols(); }
};

/// A contact's mode, by its impulse.
KickContact::Mode mode_of(const Vec3& P, double friction);

/// Of a contact that slides, whose first row is `at`: P_t = -mu P_n g_t / |g_t|, as N dg + K dP.
void add_sliding(double friction, double P_n, const Eigen::Vector2d& g_t, Eigen::Index at, MatX& N,
                 MatX& K);

/// From contacts at q, whose frames are placed here. `motion` is of no duration, at (q, v+).
void set_kick(const ModelData& model, const VecX& q, ArcDerivative& motion, KickDerivative& out);

/// z <- after it. @param extra (extra) what is given: for each contact that is, in order, dP_n; and
/// of those along a direction, its two numbers. @return dP (N)
VecX push_kick(const KickDerivative& kick, const VecX& extra, Tangent& z);
/// z <- before it. @param P_hat (N) covector of dP besides; @param extra written
void pull_kick(const KickDerivative& kick, const VecX& P_hat, Tangent& z, VecX& extra,
               VecX& residual);

}  // namespace saltus
