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
// are linear in r, dP and `extra`, what is given: dP = S (X extra - N r), S = (N W + K)^-1. Last in
// `extra` are changes of mu of what slides: dP_t = -P_n u_t / |u_t| dmu, or dp = P_n times the
// direction. At the edge of its cone a contact is taken as one that sticks.
#pragma once

#include "derivatives/arc_derivative.hpp"
#include "derivatives/frame_derivative.hpp"
#include "derivatives/rubbing.hpp"

namespace saltus {

/// A contact that pushes in a kick.
struct KickContact {
  int joint = -1;   ///< velocity of a joint with dry friction, in place of a pair
  int loop = -1;    ///< row of the equalities, likewise
  int number = -1;  ///< of the pair
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
  std::vector<int> rubs;                ///< numbers of the pairs whose mu is last in `extra`
  bool is_at_edge = false;              ///< a contact is at the edge of its cone
  VecX v;                               ///< (n_v) after it

  Eigen::Index size() const { return P.size(); }
  /// Numbers that are given, and mu of each pair in `rubs`.
  Eigen::Index extra() const { return S_X.cols(); }
  Eigen::Index given() const { return extra() - static_cast<Eigen::Index>(rubs.size()); }
};

/// A contact's mode, by its impulse.
KickContact::Mode mode_of(const Vec3& P, double friction);

/// Of a contact that slides, whose first row is `at`: P_t = -mu P_n g_t / |g_t|, as N dg + K dP = F
/// dmu. F (N) is written.
void add_sliding(double friction, double P_n, const Eigen::Vector2d& g_t, Eigen::Index at, MatX& N,
                 MatX& K, VecX& F);

/// At the edge of the cone, to 1e-6: it sticks by mu P_n, or slides by less than that part of the
/// rate that its friction has changed. Either way a small change decides whether it sticks.
/// @param W (2, 2) of the tangents
bool is_at_edge(double friction, const Vec3& P, bool slides, const Eigen::Vector2d& g_t,
                const Eigen::Matrix2d& W);

/// From contacts at q, whose frames are placed here. `motion` is of no duration, at (q, v+).
void set_kick(const ModelData& model, const VecX& q, ArcDerivative& motion, KickDerivative& out);

/// z <- after it. @param given (given), empty: 0; for each contact that is, in order, dP_n; and of
/// those along a direction, its two numbers. @return dP (N)
VecX push_kick(const KickDerivative& kick, const VecX& given, const Rubbing& friction, Tangent& z);
/// z <- before it; adds to the covector of friction. @param P_hat (N) covector of dP besides;
/// @param extra written, that of what is given first
void pull_kick(const KickDerivative& kick, const VecX& P_hat, Tangent& z, VecX& extra,
               VecX& residual, Rubbing& friction);

}  // namespace saltus
