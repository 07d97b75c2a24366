// Derivatives floor.
#include <pybind11/native_enum.h>

#include "derivative_docs.hpp"
#include "named_gradient.hpp"
#include "shared_stepper.hpp"

namespace saltus::bindings {
namespace {

/// The same as the core's structs, with pairs by name.
struct NamedImpactDerivative {
  double t;
  std::vector<std::string> pairs;
  double spread, depth;
  std::vector<std::string> weak;
};
struct NamedStepDerivative {
  StepDerivative core;
  std::vector<NamedImpactDerivative> impacts;
  std::vector<std::string> rubbing;
};
struct NamedSelection {
  Selection core;
  std::vector<std::string> pairs;
};

std::vector<std::string> names_of_pairs(const Model& model, const std::vector<int>& pairs) {
  std::vector<std::string> names;
  for (const int pair : pairs) names.push_back(model.pair_name(pair));
  return names;
}

NamedStepDerivative named(const Model& model, StepDerivative&& d) {
  NamedStepDerivative out{std::move(d), {}, {}};
  out.rubbing = names_of_pairs(model, out.core.rubbing);
  for (const ImpactDerivative& each : out.core.impacts) {
    out.impacts.push_back({each.t, names_of_pairs(model, each.pairs), each.spread, each.depth,
                           names_of_pairs(model, each.weak)});
  }
  return out;
}

/// Of each pair that rubs. What is 0 for all asks for no step.
VecX to_frictions(SharedStepper& s, const PerContact& dfriction) {
  if (py::isinstance<py::float_>(dfriction.value) && dfriction.value.cast<double>() == 0) return {};
  const auto count = s.derive([](StepDerivatives& all) { return all.rubbing().size(); });
  return to_vector(dfriction, static_cast<Eigen::Index>(count), "dfriction");
}

StepDirection to_direction(SharedStepper& s, const Velocities& dq, const Velocities& dp,
                           const py::object& du, const Velocities& dqfrc, double dh,
                           const std::optional<VecX>& drestitution, const PerContact& dfriction,
                           const std::optional<MatX>& dforces,
                           const std::optional<MatX>& dtorques) {
  const Model& model = s.stepper.model();
  StepDirection d;
  const auto vector = [&](const Velocities& x, const char* what) {
    return x.value.is_none() ? VecX() : to_vector(x, model, what);
  };
  d.q = vector(dq, "dq");
  d.p = vector(dp, "dp");
  d.qfrc = vector(dqfrc, "dqfrc");
  if (!du.is_none()) d.control = to_control(du, model);
  d.h = dh;
  if (drestitution) d.restitution = *drestitution;
  d.friction = to_frictions(s, dfriction);
  if (dforces) d.forces = *dforces;
  if (dtorques) d.torques = *dtorques;
  return d;
}

template <auto product>
std::pair<VecX, VecX> push(SharedStepper& s, const Velocities& dq, const Velocities& dp,
                           const py::object& du, const Velocities& dqfrc, double dh,
                           const std::optional<VecX>& drestitution, const PerContact& dfriction,
                           const std::optional<MatX>& dforces,
                           const std::optional<MatX>& dtorques) {
  const StepDirection d =
      to_direction(s, dq, dp, du, dqfrc, dh, drestitution, dfriction, dforces, dtorques);
  StateDirection out = s.derive([&](StepDerivatives& all) { return (all.*product)(d); });
  return {std::move(out.q), std::move(out.p)};
}

StateDirection to_covector(const SharedStepper& s, const Velocities& q_hat,
                           const Velocities& p_hat) {
  const Model& model = s.stepper.model();
  return {to_vector(q_hat, model, "q_hat"), to_vector(p_hat, model, "p_hat")};
}

StepDirection pull(SharedStepper& s, const Velocities& q_hat, const Velocities& p_hat) {
  const StateDirection covector = to_covector(s, q_hat, p_hat);
  return s.derive([&](StepDerivatives& all) { return all.vjp(covector); });
}

NamedModelGradient pull_model(SharedStepper& s, const Velocities& q_hat, const Velocities& p_hat) {
  const StateDirection covector = to_covector(s, q_hat, p_hat);
  ModelGradient out;
  s.derive([&](StepDerivatives& all) { return all.vjp(covector, out); });
  return with_names(s.stepper.model(), std::move(out));
}

StepDirection bend(SharedStepper& s, const Velocities& q_hat, const Velocities& p_hat,
                   const Velocities& dq, const Velocities& dp, const py::object& du,
                   const Velocities& dqfrc, double dh) {
  const StateDirection covector = to_covector(s, q_hat, p_hat);
  const StepDirection d = to_direction(s, dq, dp, du, dqfrc, dh, {}, {py::float_(0.0)}, {}, {});
  return s.derive([&](StepDerivatives& all) { return all.hvp(covector, d); });
}

MatX bend_all(SharedStepper& s, const Velocities& q_hat, const Velocities& p_hat) {
  const StateDirection covector = to_covector(s, q_hat, p_hat);
  return s.derive([&](StepDerivatives& all) { return all.hessian(covector); });
}

void bind_impacts(py::module_& m) {
  using I = NamedImpactDerivative;
  py::class_<I>(m, "ImpactDerivative", impact_derivative_doc)
      .def_readonly("t", &I::t)
      .def_readonly("pairs", &I::pairs)
      .def_readonly("spread", &I::spread)
      .def_readonly("depth", &I::depth)
      .def_readonly("weak", &I::weak)
      .def("__repr__", [](const I& i) {
        return "ImpactDerivative(t=" + py::repr(py::float_(i.t)).cast<std::string>() +
               ", pairs=" + py::repr(py::cast(i.pairs)).cast<std::string>() +
               ", spread=" + py::repr(py::float_(i.spread)).cast<std::string>() +
               ", depth=" + py::repr(py::float_(i.depth)).cast<std::string>() +
               ", weak=" + py::repr(py::cast(i.weak)).cast<std::string>() + ")";
      });
  using S = NamedSelection;
  py::class_<S>(m, "Selection", selection_doc)
      .def_property_readonly("impact", [](const S& s) { return s.core.impact; })
      .def_readonly("pairs", &S::pairs)
      .def_property_readonly("p", [](const S& s) { return s.core.p; })
      .def_property_readonly("A", [](const S& s) { return s.core.A; })
      .def("__repr__", [](const S& s) {
        return "Selection(impact=" + std::to_string(s.core.impact) +
               ", pairs=" + py::repr(py::cast(s.pairs)).cast<std::string>() + ")";
      });
}

void bind_step_derivative(py::module_& m) {
  using D = NamedStepDerivative;
  py::class_<D>(m, "StepDerivative", step_derivative_doc)
      .def_property_readonly("A", [](const D& d) { return d.core.A; })
      .def_property_readonly("B", [](const D& d) { return d.core.B; })
      .def_property_readonly("qfrc", [](const D& d) { return d.core.qfrc; })
      .def_property_readonly("h", [](const D& d) { return d.core.h; })
      .def_property_readonly("restitution", [](const D& d) { return d.core.restitution; })
      .def_property_readonly("friction", [](const D& d) { return d.core.friction; })
      .def_readonly("rubbing", &D::rubbing)
      .def_property_readonly("forces", [](const D& d) { return d.core.forces; })
      .def_property_readonly("torques", [](const D& d) { return d.core.torques; })
      .def_property_readonly("smoothness", [](const D& d) { return d.core.smoothness; })
      .def_readonly("impacts", &D::impacts)
      .def("__repr__", [](const D& d) {
        return "StepDerivative(n_v=" + std::to_string(d.core.A.rows() / 2) +
               ", smoothness=" + smoothness_name(d.core.smoothness) +
               ", impacts=" + py::repr(py::cast(d.impacts)).cast<std::string>() + ")";
      });
}

/// The part of a gradient that the core has.
template <auto part>
auto core_part(const NamedModelGradient& g) {
  return g.core.*part;
}

void bind_model_gradient(py::module_& m) {
  using G = NamedModelGradient;
  using M = ModelGradient;
  py::class_<G>(m, "ModelGradient", model_gradient_doc)
      .def_property_readonly("inertia", &core_part<&M::inertia>)
      .def_property_readonly("stiffness", &core_part<&M::stiffness>)
      .def_property_readonly("rest", &core_part<&M::rest>)
      .def_property_readonly("damping", &core_part<&M::damping>)
      .def_property_readonly("armature", &core_part<&M::armature>)
      .def_property_readonly("actuators", &core_part<&M::actuators>)
      .def_readonly("restitution", &G::restitution)
      .def_readonly("friction", &G::friction)
      .def_readonly("springs", &G::springs)
      .def_readonly("dampers", &G::dampers)
      .def_readonly("placements", &G::placements)
      .def("__repr__", [](const G& g) {
        return "ModelGradient(links=" + std::to_string(g.core.inertia.rows()) +
               ", n_v=" + std::to_string(g.core.damping.size()) + ")";
      });
}

}  // namespace

void bind_derivative_types(py::module_& m) {
  py::native_enum<Smoothness> verdicts(m, "Smoothness", "enum.Enum", smoothness_doc);
  for (const Smoothness each : {Smoothness::smooth, Smoothness::selection, Smoothness::one_sided,
                                Smoothness::order_dependent, Smoothness::grazing}) {
    verdicts.value(smoothness_name(each).c_str(), each);
  }
  verdicts.finalize();
  using D = StepDirection;
  py::class_<D>(m, "StepDirection", step_direction_doc)
      .def_readonly("q", &D::q)
      .def_readonly("p", &D::p)
      .def_readonly("control", &D::control)
      .def_readonly("qfrc", &D::qfrc)
      .def_readonly("h", &D::h)
      .def_readonly("restitution", &D::restitution)
      .def_readonly("friction", &D::friction)
      .def_readonly("forces", &D::forces)
      .def_readonly("torques", &D::torques)
      .def("__repr__", [](const D& d) {
        return "StepDirection(n_v=" + std::to_string(d.q.size()) +
               ", n_u=" + std::to_string(d.control.size()) + ")";
      });
  bind_model_gradient(m);
  bind_impacts(m);
  bind_step_derivative(m);
}

void bind_step_derivatives(py::class_<SharedStepper>& c) {
  using S = SharedStepper;
  const auto none = [](const char* name) { return py::arg(name) = py::none(); };
  c.def("jvp", &push<&StepDerivatives::jvp>, jvp_doc, none("dq"), none("dp"), none("du"),
        py::kw_only(), none("dqfrc"), py::arg("dh") = 0.0, none("drestitution"),
        py::arg("dfriction") = 0.0, none("dforces"), none("dtorques"))
      .def("directional", &push<&StepDerivatives::directional>, directional_doc, none("dq"),
           none("dp"), none("du"), py::kw_only(), none("dqfrc"), py::arg("dh") = 0.0,
           none("drestitution"), py::arg("dfriction") = 0.0, none("dforces"), none("dtorques"))
      .def("vjp", &pull, vjp_doc, py::arg("q_hat"), py::arg("p_hat"))
      .def("model_gradient", &pull_model, model_vjp_doc, py::arg("q_hat"), py::arg("p_hat"))
      .def("hvp", &bend, hvp_doc, py::arg("q_hat"), py::arg("p_hat"), none("dq"), none("dp"),
           none("du"), py::kw_only(), none("dqfrc"), py::arg("dh") = 0.0)
      .def("hessian", &bend_all, hessian_doc, py::arg("q_hat"), py::arg("p_hat"))
      .def(
          "derivative",
          [](S& s) {
            StepDerivative d = s.derive([](StepDerivatives& all) { return all.derivative(); });
            return named(s.stepper.model(), std::move(d));
          },
          derivative_doc)
      .def(
          "selections",
          [](S& s, int most) {
            const Model& model = s.stepper.model();
            std::vector<NamedSelection> out;
            for (Selection& each :
                 s.derive([&](StepDerivatives& all) { return all.selections(most); })) {
              auto names = names_of_pairs(model, each.pairs);
              out.push_back({std::move(each), std::move(names)});
            }
            return out;
          },
          selections_doc, py::arg("most") = 1000);
}

}  // namespace saltus::bindings
