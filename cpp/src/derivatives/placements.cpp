#include "derivatives/placements.hpp"

#include <map>
#include <string>

#include "derivatives/placed_numbers.hpp"
#include "lagrangian/packed/potentials.hpp"

namespace saltus {

using Body = PlacementGradient::Body;

void add_placements(const ModelData& model, const Packed& w, double factor, PlacementGradient& to) {
  for (int i = model.tree.joints() - 1; i >= 0; --i) {
    const Body& own = to.body[static_cast<std::size_t>(i)];
    const int parent = model.tree.parent[i];
    if (parent < 0) {
      to.by_joint.row(i) += factor * own.dF.transpose();
      continue;
    }
    Body& at_parent = to.body[static_cast<std::size_t>(parent)];
    const int slot = model.packed.slot[parent];
    const Vec3 omega = three(at(w.V, slot)), phi = angular(at_parent.turn);
    const Vec3 force = own.P.cross(omega) + own.F;
    const Vec3 change = own.dP.cross(omega) + own.P.cross(at_parent.rate) + own.dF;
    to.by_joint.row(i) +=
        factor * (rotation_of(w, slot).transpose() * (change + force.cross(phi))).transpose();
    at_parent.P += own.P;
    at_parent.dP += own.dP;
    at_parent.F += own.F;
    at_parent.dF += own.dF;
  }
}

namespace {

Body* body_at(const ModelData& model, const PackedPoint& point, PlacementGradient& to) {
  if (point.slot < 0) return nullptr;
  return &to.body[static_cast<std::size_t>(
      model.packed.joint[static_cast<std::size_t>(point.slot)])];
}

/// What x moves a point by.
Vec3 moved(const Body* body, const Vec3& P) {
  return body == nullptr ? Vec3(Vec3::Zero()) : velocity_at(body->turn, P);
}

/// A force between two points of two bodies: f on a, and of dr of both, what it changes by.
void add_line(Body* a, Body* b, const Vec3& f, const Vec3& by_r, const Vec3& by_rate) {
  const auto add = [&](Body* body, double sign) {
    if (body == nullptr) return;
    body->F += sign * f;
    body->dF += sign * by_r;
    body->dP += sign * by_rate;
  };
  add(a, 1);
  add(b, -1);
}

void add_springs(const ModelData& model, const Packed& w, PlacementGradient& to) {
  if (!model.packed.potentials) return;
  const PackedPotentials& all = *model.packed.potentials;
  for (std::size_t k = 0; k < all.springs.size(); ++k) {
    const PackedSpring& s = all.springs[k];
    const Packed::PlacedSpring& x = w.springs[k];
    Body *a = body_at(model, s.a, to), *b = body_at(model, s.b, to);
    const Vec3 dr = moved(a, x.P_a) - moved(b, x.P_b);
    Vec3 by_r = -s.stiffness * dr;
    if (!s.is_smooth()) {
      const Vec3 n = x.r / x.d, across = dr - n.dot(dr) * n;
      by_r += s.stiffness * s.length / x.d * across;
    }
    add_line(a, b, x.force, by_r, Vec3::Zero());
  }
  for (const PackedForce& each : all.forces) {
    if (Body* body = body_at(model, each.at, to)) body->F += each.force;
  }
}

/// f = -c d' n: see point_dampers.cpp.
void add_dampers(const ModelData& model, const ArcScratch& s, PlacementGradient& to) {
  for (const PlacedDamper& x : s.dampers) {
    Body *a = body_at(model, x.a, to), *b = body_at(model, x.b, to);
    const Vec3 dr = moved(a, x.P_a) - moved(b, x.P_b);
    const double along = x.n.dot(dr), rate = x.n.dot(x.r_rate);
    Vec3 by_r = Vec3::Zero();
    if (x.d > 0) {
      const Vec3 turned = x.r_rate - rate * x.n, across = dr - along * x.n;
      by_r = -x.damping / x.d * (along * turned + rate * across);
    }
    add_line(a, b, x.force, by_r, -x.damping * along * x.n);
  }
}

void add_wrenches(const ModelData& model, const ArcScratch& s, PlacementGradient& to) {
  for (const AppliedWrench& each : s.input->wrenches) {
    if (each.joint < 0) continue;
    const int slot = model.packed.slot[static_cast<std::size_t>(each.joint)];
    Body& body = to.body[static_cast<std::size_t>(each.joint)];
    body.F += each.in_body ? Vec3(rotation_of(s.w, slot) * each.force) : each.force;
  }
}

}  // namespace

void PlacementGradient::start(const ModelData& model) {
  by_joint.setZero(model.tree.joints(), 3);
  body.resize(static_cast<std::size_t>(model.tree.joints()));
  if (above.size() == model.joints.size()) return;
  std::map<std::string, const Link*> links;
  for (const Link& link : model.links) links[link.name] = &link;
  for (const JointInfo& joint : model.joints) above.push_back(links.at(joint.parent)->X_JL.R);
}

void add_point_forces(const ModelData& model, const ArcDerivative& arc, PlacementGradient& to) {
  add_springs(model, arc.s.w, to);
  add_dampers(model, arc.s, to);
  add_wrenches(model, arc.s, to);
}

MatX by_joint(const ModelData& model, const PlacementGradient& gradient) {
  MatX out = MatX::Zero(static_cast<Eigen::Index>(model.joints.size()), 3);
  for (const JointInfo& joint : model.joints) {
    if (joint.frames.empty()) continue;
    const Mat3& R = gradient.above[static_cast<std::size_t>(joint.index)];
    out.row(joint.index) = gradient.by_joint.row(joint.frames.front()) * R;
  }
  return out;
}

}  // namespace saltus
