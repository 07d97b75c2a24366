#include "saltus/force/force_function.hpp"

#include <sstream>

#include "saltus/error.hpp"

namespace saltus {
namespace {

[[noreturn]] void refuse(const FunctionForce& force, const ForceMoment& now,
                         const std::string& what) {
  std::ostringstream text;
  text << "force \"" << force.name << "\" returned " << what << " at t = " << now.t << " s";
  throw ModelError(text.str(), "force", force.name);
}

std::string shape(Eigen::Index rows, Eigen::Index cols) {
  return "(" + std::to_string(rows) + ", " + std::to_string(cols) + ")";
}

void check_partials(const FunctionForce& force, const ForceMoment& now, const MatX& x,
                    const char* name) {
  if (x.size() == 0) return;
  const auto m = static_cast<Eigen::Index>(force.velocities.size()), n = now.v.size();
  if (x.rows() != m || x.cols() != n) {
    refuse(force, now,
           std::string(name) + " of shape " + shape(x.rows(), x.cols()) + "; it is " + shape(m, n) +
               ", a row for each coordinate that it pushes");
  }
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (std::isfinite(x(i, j))) continue;
      std::ostringstream text;
      text << name << "[" << i << ", " << j << "] = " << x(i, j);
      refuse(force, now, text.str());
    }
  }
}

}  // namespace

void ask(const FunctionForce& force, const ForceMoment& now, ForceAnswer& answer) {
  for (MatX* each : {&answer.Q_q, &answer.Q_v}) each->resize(0, 0);
  answer.Q.resize(0);
  force.function(now, answer);
  const auto m = static_cast<Eigen::Index>(force.velocities.size());
  if (answer.Q.size() != m) {
    refuse(force, now,
           "Q of " + std::to_string(answer.Q.size()) + " numbers; it pushes " + std::to_string(m) +
               (m == 1 ? " coordinate" : " coordinates"));
  }
  for (Eigen::Index i = 0; i < m; ++i) {
    if (std::isfinite(answer.Q[i])) continue;
    std::ostringstream text;
    text << "Q[" << i << "] = " << answer.Q[i];
    refuse(force, now, text.str());
  }
  check_partials(force, now, answer.Q_q, "Q_q");
  check_partials(force, now, answer.Q_v, "Q_v");
}

}  // namespace saltus
