#include "variational/law/contact_problem.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "saltus/error.hpp"
#include "saltus/model/model.hpp"

namespace saltus {
namespace {

/// Of |v|_M sqrt(G_ii), the greatest rate that this kinetic energy allows: the rounding of u.
constexpr double relative_rest = 1e-13;

void check_arrays(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                  const VecRef& v) {
  std::ostringstream text;
  const auto n = v.size();
  if (M.rows() != n || M.cols() != n) {
    text << "M is (" << M.rows() << ", " << M.cols() << "); v has " << counted(n, "entry")
         << ", so M is (" << n << ", " << n << ")";
  } else if (N.cols() != n && N.rows() > 0) {
    text << "N is (" << N.rows() << ", " << N.cols() << "); v has " << counted(n, "entry")
         << ", so N is (contacts, " << n << "), a row a contact";
  } else if (!M.allFinite() || !N.allFinite() || !v.allFinite()) {
    text << "M, N or v holds a value that is not finite";
  } else if ((M - M.transpose()).norm() > 1e-12 * M.norm()) {
    text << "M is not symmetric: it differs from its transpose by " << (M - M.transpose()).norm();
  }
  if (!text.str().empty()) throw ModelError(text.str());
}

void check_contacts(const Eigen::Ref<const MatX>& N, const VecRef& restitution) {
  const auto m = N.rows();
  std::ostringstream text;
  if (restitution.size() != m) {
    text << "restitution has " << counted(restitution.size(), "entry") << "; N has "
         << counted(m, "row") << ", a row a contact";
    throw ModelError(text.str());
  }
  for (Eigen::Index i = 0; i < m; ++i) {
    if (!(N.row(i).norm() > 0)) {
      text << "row " << i << " of N is zero: no normal";
    } else if (!(restitution[i] >= 0 && restitution[i] <= 1)) {
      text << "restitution " << restitution[i] << " of contact " << i << " is outside [0, 1]";
    }
    if (!text.str().empty()) throw ModelError(text.str());
  }
}

/// Products of four of these numbers, which the laws take, are then neither infinite nor 0.
void check_size(const ContactProblem& problem) {
  constexpr double least = 1e-75, most = 1e75;
  for (Eigen::Index i = 0; i < problem.G.rows(); ++i) {
    const double g = problem.G(i, i);
    if (g >= least && g <= most && problem.G.row(i).allFinite()) continue;
    std::ostringstream text;
    text << "contact " << i << " has the inverse mass N M^-1 N' = " << g
         << "; it is from 1e-75 to 1e75: scale M and N";
    throw ModelError(text.str());
  }
  if (problem.u.allFinite() && std::isfinite(problem.speed)) return;
  throw ModelError("v'M v or N v is not finite: scale M, N and v");
}

}  // namespace

ContactProblem contact_problem(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                               const VecRef& v, const VecRef& restitution) {
  check_arrays(M, N, v);
  check_contacts(N, restitution);
  const Eigen::LLT<Eigen::MatrixXd> llt(M);
  if (llt.info() != Eigen::Success) throw ModelError("M is not positive definite");
  ContactProblem out;
  out.speed = std::sqrt(std::max(0.0, v.dot(M * v)));
  if (N.rows() == 0) {
    check_size(out);
    return out;
  }
  out.columns = llt.solve(N.transpose());
  const MatX product = N * out.columns;
  out.G = 0.5 * (product + product.transpose());
  out.u = N * v;
  check_size(out);
  out.rest = relative_rest * out.speed * out.G.diagonal().array().sqrt();
  return out;
}

MatX dense_part(const ContactMatrix& G, const std::vector<int>& part) {
  const auto m = static_cast<Eigen::Index>(part.size());
  MatX dense = MatX::Zero(m, m);
  for (Eigen::Index row = 0; row < m; ++row) {
    const int i = part[static_cast<std::size_t>(row)];
    for (int k = G.start[i]; k < G.start[i + 1]; ++k) {
      const auto at = std::lower_bound(part.begin(), part.end(), G.column[k]);
      if (at != part.end() && *at == G.column[k]) dense(row, at - part.begin()) = G.value[k];
    }
  }
  return dense;
}

ContactBlocks contact_blocks(const MatX& W) {
  ContactBlocks out;
  const auto m = static_cast<std::size_t>(W.rows() / 3);
  for (std::size_t i = 0; i < m; ++i) {
    out.start.push_back(static_cast<int>(out.contact.size()));
    for (std::size_t j = 0; j < m; ++j) {
      const Mat3 block = W.block<3, 3>(3 * j, 3 * i);
      if (block.isZero(0)) continue;
      out.contact.push_back(static_cast<int>(j));
      out.block.push_back(block);
    }
    out.own.push_back(W.block<3, 3>(3 * i, 3 * i));
  }
  out.start.push_back(static_cast<int>(out.contact.size()));
  for (auto* each : {&out.friction, &out.restitution, &out.rest}) each->assign(m, 0.0);
  return out;
}

}  // namespace saltus
