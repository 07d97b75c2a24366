#include "saltus/model/close_loops.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/assembly.hpp"
#include "saltus/lagrangian/partials.hpp"
#include "saltus/tree/coordinates.hpp"

namespace saltus {
namespace {

/// The rows of h and of what stays, and the steps that meet them: dq = M^-1 C^T (C M^-1 C^T)^+ x.
struct Steps {
  Steps(const ModelData& model, const VecRef& q, const MatX& A, const std::vector<int>& keep) {
    C.setZero(A.cols() + static_cast<Eigen::Index>(keep.size()), A.rows());
    C.topRows(A.cols()) = A.transpose();
    for (std::size_t k = 0; k < keep.size(); ++k) {
      C(A.cols() + static_cast<Eigen::Index>(k), keep[k]) = 1;
    }
    // L L^T = M: the shortest dq in its metric is L^-T times the shortest y with C L^-T y = x
    const Eigen::LLT<MatX> llt(mass_matrix(model.tree, model.packed, q));
    U = llt.matrixU();
    // 1e-10: rows that say the same twice differ by the rounding of poses
    root.setThreshold(1e-10);
    const MatX scaled = U.transpose().triangularView<Eigen::Lower>().solve(C.transpose());
    root.compute(scaled.transpose());
  }
  VecX step(const VecX& x) const {
    return U.triangularView<Eigen::Upper>().solve(VecX(root.solve(x)));
  }
  MatX C, U;
  Eigen::CompleteOrthogonalDecomposition<MatX> root;
};

/// The row that is farthest from 0, as a part of its size.
int worst_row(const EqualityValues& values) {
  int worst = 0;
  (values.h.array().abs() / (values.size.array() + 1e-300)).maxCoeff(&worst);
  return worst;
}

double openness(const EqualityValues& values) {
  if (values.h.size() == 0) return 0;
  return (values.h.array().abs() / (values.size.array() + 1e-300)).maxCoeff();
}

[[noreturn]] void fail_open(const Model& model, const EqualityValues& values) {
  const int row = worst_row(values);
  const Equality& loop = equality_of(*model, row);
  std::ostringstream text;
  text << "loop " << quoted(loop.name) << " stays open by " << std::abs(values.h[row])
       << ": no configuration that closes it was found from here; start nearer to one (not from a "
          "straight arm, which bends neither way), or keep fewer coordinates";
  throw ModelError(text.str(), "loop", loop.name);
}

VecX with_zeros(const VecX& h, std::size_t kept) {
  VecX x = VecX::Zero(h.size() + static_cast<Eigen::Index>(kept));
  x.head(h.size()) = h;
  return x;
}

void check_kept(const Model& model, const std::vector<int>& keep) {
  for (const int k : keep) {
    if (k >= 0 && k < model.n_v()) continue;
    throw ModelError("keep names velocity " + std::to_string(k) + "; there are " +
                     std::to_string(model.n_v()));
  }
}

}  // namespace

EqualityValues loop_values(const ModelData& model, const VecRef& q, double t) {
  Kinematics kin(model.tree);
  set_configuration(model.tree, q, kin);
  EqualityValues out(model.tree.n_v, model.equalities.rows);
  set_equalities(model.tree, model.equalities, kin, q, t, out);
  return out;
}

const Equality& equality_of(const ModelData& model, int row) {
  const Equality* found = &model.equalities.all.front();
  for (const Equality& each : model.equalities.all) {
    if (each.first <= row) found = &each;
  }
  return *found;
}

VecX loop_gaps(const Model& model, const VecRef& q, double t) {
  return loop_values(*model, model.checked_q(q, "q"), t).h;
}

VecX close_loops(const Model& model, const VecRef& q_start, const std::vector<int>& keep,
                 double t) {
  check_kept(model, keep);
  VecX q = model.checked_q(q_start, "q");
  EqualityValues values = loop_values(*model, q, t);
  constexpr int most_iterations = 100, most_halvings = 30;
  constexpr double rounding = 1e-14;
  double open = openness(values);
  for (int k = 0; k < most_iterations && open > rounding; ++k) {
    VecX dq = Steps(*model, q, values.A, keep).step(with_zeros(-values.h, keep.size()));
    for (const int kept : keep) dq[kept] = 0;  // also where the loops would not have it
    double after = open;
    VecX q_new;
    for (int halving = 0; halving < most_halvings && !(after < open); ++halving, dq /= 2) {
      q_new = model.integrate(q, dq);
      values = loop_values(*model, q_new, t);
      after = openness(values);
    }
    if (!(after < open)) break;
    q = q_new;
    open = after;
  }
  values = loop_values(*model, q, t);
  // what is left of Newton's method at rounding, or a loop that does not close
  if (!(open <= 1e-12)) fail_open(model, values);
  return q;
}

VecX consistent_velocity(const Model& model, const VecRef& q, const VecRef& v,
                         const std::vector<int>& keep, double t) {
  check_kept(model, keep);
  check_vector(v, model.n_v(), "v", "velocities");
  const VecX at = model.checked_q(q, "q");
  const EqualityValues values = loop_values(*model, at, t);
  const Steps steps(*model, at, values.A, keep);
  const VecX rates = values.A.transpose() * v - values.drive;
  VecX out = v + steps.step(with_zeros(-rates, keep.size()));
  for (const int kept : keep) out[kept] = v[kept];
  const VecX left = values.A.transpose() * out - values.drive;
  // what stands still beside what is fast has the rounding of that
  const double fastest = std::max(out.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff());
  const VecX size =
      values.A.cwiseAbs().transpose() * VecX::Constant(v.size(), fastest) + values.drive.cwiseAbs();
  for (int row = 0; row < model->equalities.rows; ++row) {
    if (std::abs(left[row]) <= 1e-10 * size[row]) continue;
    const Equality& loop = equality_of(*model, row);
    std::ostringstream text;
    text << "loop " << quoted(loop.name) << " opens at a rate of " << std::abs(left[row])
         << (keep.empty() ? "; no velocities keep it closed: loops, or what is told, contradict it"
                          : " with the velocities that are kept; keep fewer");
    throw ModelError(text.str(), "loop", loop.name);
  }
  return out;
}

}  // namespace saltus
