#include "saltus/rollout/control.hpp"

#include <algorithm>

namespace saltus {

Policy constant_control(const VecX& u) {
  return [u](const Moment& now, ForceInput& input) {
    if (now.step == 0) input.control = u;
  };
}

Policy control_rows(MatX rows) {
  return [rows = std::move(rows)](const Moment& now, ForceInput& input) {
    if (rows.rows() == 0) return;
    input.control = rows.row(std::min<Eigen::Index>(now.step, rows.rows() - 1));
  };
}

}  // namespace saltus
