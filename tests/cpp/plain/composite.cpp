#include "plain/composite.hpp"

namespace saltus::plain {
namespace {

/// Half the joints of a free or spherical one carry no body of their own.
Inertia world_inertia(const BodyInertia& body, const JointMotion& m) {
  if (body.mass == 0) return {};
  return inertia_about(body.mass, m.p + m.R * body.c_J, m.R * body.I_J * m.R.transpose());
}

}  // namespace

void first_pass(const Tree& tree, const MassModel& mass, const Kinematics& kin, Composite& comp) {
  for (int i = 0; i < tree.joints(); ++i) {
    JointComposite& c = comp.joint[i];
    c.Ic = world_inertia(mass.body[i], kin.joint[i]);
    if (mass.body[i].mass == 0) {
      c.H.setZero();
      c.g.setZero();
      continue;
    }
    c.H = c.Ic * kin.joint[i].V;
    c.g = spatial(c.Ic.h.cross(mass.gravity), c.Ic.mass * mass.gravity);
  }
  for (int i = tree.joints() - 1; i >= 0; --i) {
    const JointMotion& m = kin.joint[i];
    const JointComposite& c = comp.joint[i];
    comp.L_v[i] = m.S.dot(c.H);
    comp.L_q[i] = m.W.dot(c.H) + m.S.dot(c.g);
    if (tree.parent[i] < 0) continue;
    comp.joint[tree.parent[i]].H += c.H;
    comp.joint[tree.parent[i]].g += c.g;
  }
}

void second_pass(const Tree& tree, const MassModel& mass, const Kinematics& kin, Composite& comp) {
  for (int i = tree.joints() - 1; i >= 0; --i) {
    const JointMotion& m = kin.joint[i];
    JointComposite& c = comp.joint[i];
    c.U = c.Ic * m.S;
    c.F = c.Ic * m.W + cross_force(m.S, c.H);
    c.G = linear(c.U).cross(mass.gravity);
    if (tree.parent[i] >= 0) comp.joint[tree.parent[i]].Ic += c.Ic;
  }
}

void mass_pass(const Tree& tree, const MassModel& mass, const Kinematics& kin, Composite& comp) {
  for (int i = 0; i < tree.joints(); ++i) {
    comp.joint[i].Ic = world_inertia(mass.body[i], kin.joint[i]);
  }
  for (int i = tree.joints() - 1; i >= 0; --i) {
    JointComposite& c = comp.joint[i];
    c.U = c.Ic * kin.joint[i].S;
    if (tree.parent[i] >= 0) comp.joint[tree.parent[i]].Ic += c.Ic;
  }
}

}  // namespace saltus::plain
