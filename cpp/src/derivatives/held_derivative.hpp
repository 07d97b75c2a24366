// An arc with the contacts that it holds, and the kick that closes it (theory, D6).
//
// The impulses P of an arc act along the rows C = n, t0, t1 at its start. What they meet are rates
// g: the gap at the arc's end, and the slip in its middle, T(q_m) v, or of a corner its chord over
// the arc. With the arc's own derivative linear in z = (dq, dp), and R its answer to dp = C,
//
//   z.p += P dC,   z <- arc z,   z += R dP   so that  N (dg + W dP) + K dP = 0,   W = g(R)
//
// N and K by mode: a gap stays closed, g_n = 0; what sticks has g_t = 0; what slides
// P_t = -mu P_n g_t / |g_t|, and F dmu on the right.
#pragma once

#include <memory>

#include "derivatives/energy_derivative.hpp"
#include "derivatives/kick_derivative.hpp"
#include "derivatives/parameters.hpp"

namespace saltus {

struct HeldArc {
  VecX P;                               ///< (N)
  std::vector<FrameDerivative> frames;  ///< at the start, one a contact
  std::vector<int> contact_of, row_of;  ///< (N)
  MatX R_q, R_p;                        ///< (n_v, N)
  MatX G_q, G_v, G_m, G_0;  ///< (n_v, N) g by dq of the end, dv, dq of the middle, dq of the start
  MatX S_N;                 ///< (N, N)
  MatX S_F;                 ///< (N, slides) dP by mu of each pair that slides
  std::vector<int> slides;  ///< numbers of those
  bool is_at_edge = false;  ///< a contact is at the edge of its cone
  VecX rubs;  ///< (n_v) [N] what joints that slide push more, as the arc grows longer; or empty

  Eigen::Index size() const { return P.size(); }
};

/// An arc with what held it, and the kick at its end.
struct FlownArc {
  explicit FlownArc(const ModelData& model) : arc(model) {}
  const TapeArc* told = nullptr;  ///< of the tape that it was set from
  ArcDerivative arc;
  MatchDerivative match;
  HeldArc held;
  KickDerivative kick;
  /// Of what is given to the kick, in order: the first tangential row in `held` of a direction; or
  /// -1, a joint that slides and pushes in proportion to the arc's duration, by `rate`.
  struct Source {
    int row;
    double rate;
  };
  std::vector<Source> source;
  std::unique_ptr<NodeDerivative> node;  ///< of the kick, where one has been
  MatX dense;              ///< (2 n_v, 2 n_v) of a plain arc, where it has been asked for
  bool has_dense = false;  ///< then

  /// A contact of it is at the edge of its cone.
  bool is_at_edge() const {
    return (held.size() > 0 && held.is_at_edge) || (kick.size() > 0 && kick.is_at_edge);
  }
};

/// Writes all of `out`. @throws ModelError as set_arc_derivative
void set_flown_arc(const ModelData& model, const Tape& tape, const TapeArc& told, FlownArc& out);

void push_flown(const ModelData& model, FlownArc& arc, const VecX& dQ, double dtau,
                const Rubbing& friction, Tangent& z);
/// @param friction its covector is added to; @param to parameters, or nullptr
double pull_flown(const ModelData& model, FlownArc& arc, VecX& Q, Tangent& z, Rubbing& friction,
                  ParameterGradient* to);

/// Of contacts that the tape tells.
KickContact contact_of(const ModelData& model, const TapeRow& row);

/// What a kick adds by the inertias and placements that it meets, pulled back to p_hat; w is
/// scratch.
void add_kick_gradient(const ModelData& model, const VecX& q, const KickDerivative& kick,
                       const VecX& residual, const VecX& p_hat, Packed& w, ParameterGradient& to);

}  // namespace saltus
