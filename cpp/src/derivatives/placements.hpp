// Gradients by the lengths of joints' placements: by where a joint's frame is in its parent's.
//
// Moved by a step e, in the parent's axes, a joint carries all that is beyond it by d = R_P e, as a
// joint without a rate would that slides there. Of x.L_q + y.L_v it is with P, F, the momentum of
// what is beyond and the forces on it, and ' what x and y make of them,
//
//   e_hat = R_P^T [d/d(x, y) (P x w_P + F) + (P x w_P + F) x phi_P]      phi_P: how x turns it
//
// A force f on a point, that a spring or a damper makes of r, r' between its two ends, adds to F
// and F'; by r', c' = (df/dr')^T dr, it acts as a momentum would: P' += c'.
#pragma once

#include "derivatives/arc_derivative.hpp"

namespace saltus {

/// Room for it; `by_joint` is the answer.
struct PlacementGradient {
  MatX by_joint;  ///< (joints of the tree, 3) in the axes of each one's parent

  // scratch, by joint
  struct Body {
    Vec6 turn;   ///< of x: [phi; of O]
    Vec3 rate;   ///< of w by x and y, in the world's axes
    Vec3 P, dP;  ///< of what is beyond the joint
    Vec3 F, dF;
  };
  std::vector<Body> body;
  std::vector<Mat3> above;  ///< (joints) axes of their parent links in those of the tree's joints

  void start(const ModelData& model);
};

/// A body with its own momentum and weight. @param own its twist in its joint's frame @param change
/// that by x and y; twist the same in the world's axes, about O
inline void set_body(const BodyInertia& inertia, const Vec3& gravity, const Mat3& R,
                     const Vec6& own, const Vec6& change, const Vec6& turn, const Vec6& twist,
                     PlacementGradient::Body& to) {
  const Vec3 phi = angular(turn);
  to.turn = turn;
  to.rate = angular(twist) + phi.cross(R * angular(own));
  to.P = inertia.mass * (R * (linear(own) + angular(own).cross(inertia.c_J)));
  to.dP =
      inertia.mass * (R * (linear(change) + angular(change).cross(inertia.c_J))) + phi.cross(to.P);
  to.F = inertia.mass * gravity;
  to.dF.setZero();
}

/// Adds to the bodies what acts at points of them in an arc.
void add_point_forces(const ModelData& model, const ArcDerivative& arc, PlacementGradient& to);

/// to.by_joint += factor (what placements make of x.L_q + y.L_v) at w, from the bodies: their
/// numbers are summed up.
void add_placements(const ModelData& model, const Packed& w, double factor, PlacementGradient& to);

/// From the tree's joints to the model's: (joints, 3) in each parent link's axes; 0 of fixed ones.
MatX by_joint(const ModelData& model, const PlacementGradient& gradient);

}  // namespace saltus
