// A description that comes from elsewhere, checked as if it were described anew.
#include "model/assembly.hpp"
#include "model/shape_checks.hpp"

namespace saltus {

ModelDescription ModelBuilder::checked(const ModelDescription& d) {
  if (d.links.empty() || d.links.front().name != d.root) {
    throw ModelError("the first link of a description is its root, " + quoted(d.root), "link",
                     d.root);
  }
  const LinkSpec& root = d.links.front();
  check_inertia(root.inertia, root.name, root.check);
  ModelBuilder again(d.name, d.root);
  again.d_.links = {root};
  again.set_gravity(d.gravity).set_solver(d.solver).set_source(d.source);
  for (std::size_t i = 1; i < d.links.size(); ++i) again.add_link(d.links[i]);
  for (const JointSpec& joint : d.joints) again.add_joint(joint);
  for (const ActuatorSpec& actuator : d.actuators) again.add_actuator(actuator);
  for (const LoopSpec& loop : d.loops) {
    again.add_loop(loop.name, loop.type, loop.a, loop.b, loop.distance);
  }
  for (const CouplingSpec& coupling : d.couplings) {
    again.add_coupling(coupling.joint, coupling.of, coupling.polynomial);
  }
  for (const PrescribedSpec& spec : d.prescribed) again.set_prescribed(spec);
  for (const SpringSpec& spring : d.springs) again.add_spring(spring);
  for (const ForceSpec& force : d.forces) again.add_force(force);
  for (const PotentialFunction& potential : d.potentials) again.add_potential(potential);
  for (const LinkSpec& link : d.links) {
    if (link.compensation != 0) again.set_gravity_compensation(link.name, link.compensation);
  }
  for (const Visual& visual : d.visuals) again.add_visual(visual);
  for (ShapeSpec shape : d.shapes) {
    check_shape(shape.shape, shape.link);
    shape.X_LG = checked_pose(shape.X_LG, "link", shape.link);
    if (shape.contact) check_properties(*shape.contact, quoted(shape.name) + " and all else");
    again.d_.shapes.push_back(shape);
  }
  for (const auto& [pair, properties] : d.materials.contact) {
    again.set_contact(pair.first, pair.second, properties);
  }
  for (const auto& [link, material] : d.materials.of_link) again.set_material(link, material);
  if (d.materials.standard) again.set_default_contact(*d.materials.standard);
  for (const StateSpec& state : d.states) again.add_state(state);
  for (const SensorSpec& sensor : d.sensors) again.add_sensor(sensor);
  again.d_.filter = d.filter;
  again.d_.warnings = d.warnings;
  return std::move(again.d_);
}

}  // namespace saltus
