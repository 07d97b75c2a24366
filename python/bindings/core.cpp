// The extension module saltus._core.
#include "bindings.hpp"
#include "pickle.hpp"

PYBIND11_MODULE(_core, m) {
  using namespace saltus::bindings;
  m.doc() = "Compiled part of saltus; everything public is in the package itself.";
  m.attr("__version__") = SALTUS_VERSION;
  bind_errors(m);
  bind_spatial(m);
  bind_lagrangian(m);
  bind_collision(m);
  bind_model(m);
  bind_model_builder(m);
  bind_motion(m);
  bind_dynamics(m);
  bind_urdf(m);
  bind_variational(m);
  bind_contact_space(m);
  bind_stepper(m);
  bind_rollout(m);
  bind_batch(m);
  use_one_protocol(m);
  explain_errors(m);
}
