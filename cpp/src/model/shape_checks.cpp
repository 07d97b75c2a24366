#include "model/shape_checks.hpp"

#include "collision/shapes/facts.hpp"
#include "saltus/error.hpp"

namespace saltus {

void check_shape(const Shape& shape, const std::string& link) {
  const std::string what = flaw(shape), name = shape_name(shape);
  if (what.empty()) return;
  const bool vowel = std::string("aeiou").find(name[0]) != std::string::npos;
  throw ModelError("link \"" + link + "\" has " + (vowel ? "an " : "a ") + name + " " + what,
                   "link", link);
}

Pose checked_pose(const Pose& X, const std::string& element, const std::string& name) {
  const bool finite = X.p.allFinite() && X.R.allFinite();
  const double defect = (X.R.transpose() * X.R - Mat3::Identity()).norm();
  // 1e-6: what is left of a rotation written with six digits
  if (!finite || !(defect < 1e-6) || X.R.determinant() < 0) {
    throw ModelError(element + " \"" + name + "\" has a placement that is " +
                         (finite ? "no rotation" : "not finite"),
                     element, name);
  }
  if (defect < 1e-14) return X;  // as good as computed; zeros and ones stay as they are
  return {Eigen::Quaterniond(X.R).normalized().toRotationMatrix(), X.p};
}

}  // namespace saltus
