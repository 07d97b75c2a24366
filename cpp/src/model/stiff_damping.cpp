#include "saltus/model/stiff_damping.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <sstream>

#include "saltus/lagrangian/partials.hpp"

namespace saltus {

double damping_shift(double z) {
  if (!(z > most_damping)) return 0;
  return 1 - 2 / std::exp2(std::ceil(std::log2(z)));
}

VecX damping_ratios(const Model& model, double h, const VecRef& q) {
  if (!(std::isfinite(h) && h > 0)) {
    std::ostringstream text;
    text << "h = " << h << " s; a step is positive";
    throw ModelError(text.str());
  }
  const VecX at = model.checked_q(q, "q");
  VecX z = VecX::Zero(model.n_v());
  if (model->forces.damping.size() == 0) return z;
  const Eigen::LLT<MatX> llt(mass_matrix(model->tree, model->packed, at));
  for (int c = 0; c < model.n_v(); ++c) {
    if (model->forces.damping[c] == 0) continue;
    z[c] = h * model->forces.damping[c] * llt.solve(VecX::Unit(model.n_v(), c))[c];
  }
  for (const Ball& ball : model->tree.balls) z.segment<3>(ball.velocity).setZero();
  return z;
}

std::vector<std::string> stiff_joints(const Model& model, double h, const VecRef& q) {
  const VecX z = damping_ratios(model, h, q);
  std::vector<std::string> names;
  for (const JointInfo& joint : model->joints) {
    bool is_stiff = false;
    for (const int c : joint.velocities) is_stiff = is_stiff || z[c] > most_damping;
    if (is_stiff && joint.mimics.empty()) names.push_back(joint.name);
  }
  return names;
}

}  // namespace saltus
