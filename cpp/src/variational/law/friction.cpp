#include "saltus/variational/friction.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "saltus/model/model.hpp"
#include "variational/law/contact_problem.hpp"
#include "variational/law/coulomb.hpp"
#include "variational/law/friction_together.hpp"
#include "variational/law/pile.hpp"

namespace saltus {
namespace {

/// The contact that collides next, -1 where none approaches.
int next_contact(const ContactBlocks& W, ImpactOrder order, const std::vector<Vec3>& u) {
  int next = -1;
  double least = 0;
  for (int i = 0; i < W.size(); ++i) {
    if (!(u[i][0] < -W.rest[i])) continue;
    if (order == ImpactOrder::index) return i;
    const double key = u[i][0] / std::sqrt(W.own[i](0, 0));
    if (key < least) {
      least = key;
      next = i;
    }
  }
  return next;
}

/// Dry friction of a joint: as much as stops it, and `bound` at most.
Vec3 stop_joint(double W, double u, double bound) {
  return {std::clamp(-u / W, -bound, bound), 0, 0};
}

ContactBlocks blocks_of(const MatX& W, const VecX& rest, const VecRef& e, const VecRef& mu) {
  ContactBlocks out = contact_blocks(W);
  out.friction.assign(mu.begin(), mu.end());
  out.restitution.assign(e.begin(), e.end());
  out.rest.assign(rest.begin(), rest.end());
  return out;
}

bool all_plastic(const ContactBlocks& W) {
  return W.size() > 1 &&
         std::all_of(W.restitution.begin(), W.restitution.end(), [](double e) { return e == 0; });
}

/// Contacts that do not rebound are resolved all at once: no order, no convention.
bool stop_together(const ContactBlocks& W, PileScratch& pile, std::vector<Vec3>& u,
                   std::vector<Vec3>& p, std::vector<FrictionImpulse>& impulses) {
  p.assign(u.size(), Vec3::Zero());
  if (!(settle_for_sure(W, pile, u, p).excess <= large_residual)) return false;
  for (int i = 0; i < W.size(); ++i) {
    if (p[i][0] > 0) impulses.push_back({i, p[i]});
  }
  return true;
}

void check_friction(const Eigen::Ref<const MatX>& N, const Eigen::Ref<const MatX>& T,
                    const VecRef& friction) {
  std::ostringstream text;
  if (T.rows() != 2 * N.rows() || T.cols() != N.cols()) {
    text << "T is (" << T.rows() << ", " << T.cols() << "); N is (" << N.rows() << ", " << N.cols()
         << "), so T is (" << 2 * N.rows() << ", " << N.cols() << "), two rows a contact";
  } else if (friction.size() != N.rows()) {
    text << "friction has " << counted(friction.size(), "entry") << "; N has "
         << counted(N.rows(), "row");
  } else if (!T.allFinite()) {
    text << "T holds a value that is not finite";
  } else if (friction.size() > 0 && !(friction.minCoeff() >= 0 && friction.allFinite())) {
    Eigen::Index bad = 0;
    while (friction[bad] >= 0 && std::isfinite(friction[bad])) ++bad;
    text << "friction is finite and not negative; that of contact " << bad << " is "
         << friction[bad];
  }
  if (!text.str().empty()) throw ModelError(text.str());
}

}  // namespace

bool collide(const ContactBlocks& W, const CascadeOptions& options, std::vector<Vec3>& u,
             std::vector<Vec3>& scratch, std::vector<FrictionImpulse>& impulses) {
  PileScratch pile;
  return collide(W, options, pile, u, scratch, impulses);
}

bool collide(const ContactBlocks& W, const CascadeOptions& options, PileScratch& pile,
             std::vector<Vec3>& u, std::vector<Vec3>& scratch,
             std::vector<FrictionImpulse>& impulses) {
  if (all_plastic(W)) return stop_together(W, pile, u, scratch, impulses);
  if (options.order == ImpactOrder::symmetric) {
    return collide_together(W, options.max_impulses, pile, u, impulses);
  }
  for (int count = 0;; ++count) {
    const int i = next_contact(W, options.order, u);
    if (i < 0) return true;
    if (count == options.max_impulses) return false;
    const Vec3 p = collide_contact(W.own[i], u[i], W.friction[i], W.restitution[i]);
    const double after = -W.restitution[i] * u[i][0];
    add_rates(W, i, p, u);
    if (W.friction[i] == 0) u[i][0] = after;  // exact, without the rounding of W p
    impulses.push_back({i, p});
  }
}

int settle(const ContactBlocks& W, int most_sweeps, std::vector<Vec3>& u, std::vector<Vec3>& p) {
  for (int sweep = 1; sweep <= most_sweeps; ++sweep) {
    double change = 0, size = 0;
    for (int i = 0; i < W.size(); ++i) {
      const Vec3 free = u[i] - W.own[i] * p[i];
      const double bound = W.bound_of(i);
      const Vec3 stopped = bound > 0 ? stop_joint(W.own[i](0, 0), free[0], bound)
                                     : stop_contact(W.own[i], free, W.friction[i]);
      const Vec3 dp = stopped - p[i];
      add_rates(W, i, dp, u);
      p[i] += dp;
      change = std::max(change, dp.cwiseAbs().maxCoeff());
      size = std::max(size, std::abs(p[i][0]));
    }
    if (change <= 1e-14 * size) return sweep;
  }
  return most_sweeps;
}

FrictionOutcome resolve_impact(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                               const Eigen::Ref<const MatX>& T, const VecRef& v,
                               const VecRef& restitution, const VecRef& friction,
                               const CascadeOptions& options) {
  if (options.max_impulses < 1) {
    throw ModelError("max_impulses " + std::to_string(options.max_impulses) + " is less than 1");
  }
  const ContactProblem plain = contact_problem(M, N, v, restitution);
  check_friction(N, T, friction);
  const auto m = N.rows();
  MatX R(3 * m, N.cols());
  for (Eigen::Index i = 0; i < m; ++i) {
    R.row(3 * i) = N.row(i);
    R.middleRows(3 * i + 1, 2) = T.middleRows(2 * i, 2);
  }
  const MatX columns = Eigen::MatrixXd(M).llt().solve(Eigen::MatrixXd(R.transpose()));
  const ContactBlocks W = blocks_of(R * columns, plain.rest, restitution, friction);
  std::vector<Vec3> u(static_cast<std::size_t>(m));
  for (Eigen::Index i = 0; i < m; ++i) u[static_cast<std::size_t>(i)] = R.middleRows(3 * i, 3) * v;
  FrictionOutcome out{v, {}};
  std::vector<Vec3> scratch;
  if (!collide(W, options, u, scratch, out.impulses)) {
    std::ostringstream text;
    text << "the impact does not end within " << options.max_impulses
         << " impulses: bodies jammed between others, or max_impulses is too small";
    double worst = 0;
    for (const Vec3& each : u) worst = std::min(worst, each[0]);
    throw JammedError(text.str(), 0, worst, options.max_impulses);
  }
  for (const FrictionImpulse& impulse : out.impulses) {
    out.v += columns.middleCols(3 * impulse.contact, 3) * impulse.p;
  }
  return out;
}

}  // namespace saltus
