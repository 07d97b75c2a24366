// What a model says of q: checks, and functions between q and v.
#include <cmath>
#include <numbers>
#include <sstream>

#include "saltus/model/model.hpp"
#include "saltus/tree/coordinates.hpp"

namespace saltus {
namespace {

/// The joint whose quaternion begins at a coordinate.
const JointInfo& joint_of(const ModelData& model, const Ball& ball) {
  const std::string& name = model.coordinates[static_cast<std::size_t>(ball.coordinate)].joint;
  const auto found = std::find_if(model.joints.begin(), model.joints.end(),
                                  [&](const JointInfo& joint) { return joint.name == name; });
  return *found;
}

[[noreturn]] void refuse_quaternion(const ModelData& model, const Ball& ball, const VecX& q,
                                    const std::string& what) {
  const std::string& joint = joint_of(model, ball).name;
  const auto x = q.segment<4>(ball.coordinate);
  std::ostringstream text;
  text.precision(9);  // what is refused differs from length 1 by 1e-6
  text << what << " has the quaternion (" << x[0] << " " << x[1] << " " << x[2] << " " << x[3]
       << ") for joint \"" << joint << "\", of length " << x.norm()
       << "; its length is 1 (x y z w, the identity is 0 0 0 1)";
  throw ModelError(text.str(), "joint", joint);
}

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

}  // namespace

VecX Model::checked_q(const VecRef& given, const std::string& what) const {
  check_vector(given, n_q(), what);
  VecX q = given;
  for (const Ball& ball : data_->tree.balls) {
    auto x = q.segment<4>(ball.coordinate);
    const double square = x.squaredNorm();
    // 1e-6: what is left of one written with six digits
    if (!(std::abs(square - 1) <= 2e-6)) refuse_quaternion(*data_, ball, q, what);
    // one that is normalised to rounding keeps its bits
    if (std::abs(square - 1) > 1e-15) x /= std::sqrt(square);
  }
  return q;
}

VecX Model::normalized(const VecRef& given) const {
  check_vector(given, n_q(), "q");
  VecX q = given;
  for (const Ball& ball : data_->tree.balls) {
    const double length = q.segment<4>(ball.coordinate).stableNorm();
    if (!(length > 0)) refuse_quaternion(*data_, ball, q, "q");
    q.segment<4>(ball.coordinate) /= length;
  }
  return q;
}

VecX Model::neutral() const {
  VecX q = saltus::neutral(data_->tree);
  for (const JointLimit& limit : data_->limits) {
    double& x = q[limit.coordinate];
    x = limit.stop.side > 0 ? std::max(x, limit.stop.bound) : std::min(x, limit.stop.bound);
  }
  return q;
}

VecX Model::integrate(const VecRef& q, const VecRef& dv) const {
  VecX out = checked_q(q, "q");
  check_vector(dv, n_v(), "dv", "velocities");
  saltus::integrate(data_->tree, out, 1, dv, out);
  return out;
}

VecX Model::difference(const VecRef& q0, const VecRef& q1) const {
  VecX out(n_v());
  saltus::difference(data_->tree, checked_q(q0, "q0"), checked_q(q1, "q1"), out);
  return out;
}

VecX Model::random_configuration(std::mt19937_64& random) const {
  VecX q(n_q());
  for (int i = 0; i < n_q(); ++i) {
    const Coordinate& c = data_->coordinates[static_cast<std::size_t>(i)];
    const double most = c.unit == Unit::radian ? std::numbers::pi : 1;
    const bool limited = std::isfinite(c.lower) && std::isfinite(c.upper);
    q[i] = limited ? uniform(random, c.lower, c.upper) : uniform(random, -most, most);
  }
  std::normal_distribution<double> normal;
  for (const Ball& ball : data_->tree.balls) {
    auto x = q.segment<4>(ball.coordinate);
    do {
      for (int k = 0; k < 4; ++k) x[k] = normal(random);
    } while (!(x.norm() > 1e-3));  // else its direction is rounding
    x.normalize();
  }
  return q;
}

}  // namespace saltus
