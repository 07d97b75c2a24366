// The only file that knows ProxSuite: its headers take as long to compile as a floor of ours.
#include "variational/law/small_qp.hpp"

#include <optional>
#include <proxsuite/proxqp/dense/dense.hpp>

namespace saltus {

Eigen::VectorXd solve_qp(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                         const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                         const Eigen::MatrixXd& C, const Eigen::VectorXd& c) {
  constexpr double infinity = 1e20;  // ProxQP's
  const auto n = H.rows();
  proxsuite::proxqp::dense::QP<double> qp(n, A.rows(), C.rows());
  qp.settings.eps_abs = 1e-10;
  qp.settings.eps_rel = 0;
  qp.settings.max_iter = 1000;
  qp.settings.eps_primal_inf = 1e-12;  // 1e-4 takes ill-conditioned problems for infeasible ones
  qp.settings.eps_dual_inf = 1e-12;
  const Eigen::VectorXd none = Eigen::VectorXd::Constant(c.size(), infinity);
  // a scaling of ProxQP's own would treat like unknowns unlike
  const bool precondition = false;
  if (A.rows() == 0) {
    qp.init(H, g, std::nullopt, std::nullopt, C, c, none, precondition);
  } else {
    qp.init(H, g, A, b, C, c, none, precondition);
  }
  qp.solve();
  return qp.results.x;
}

}  // namespace saltus
