// Model floor: functions between coordinates and velocities.
#include <random>

#include "bindings.hpp"
#include "model_docs.hpp"

namespace saltus::bindings {
namespace {

/// A 64-bit seed from a number, a NumPy Generator, or nothing.
std::uint64_t to_seed(const py::object& random) {
  const py::object generator =
      py::module_::import("numpy").attr("random").attr("default_rng")(random);
  const auto below = static_cast<std::int64_t>(0x7fffffffffffffff);
  return generator.attr("integers")(below).cast<std::uint64_t>();
}

}  // namespace

void bind_configurations(py::class_<Model>& c) {
  c.def("neutral", &Model::neutral, docs::model_neutral)
      .def(
          "integrate",
          [](const Model& model, const Coordinates& q, const Velocities& dv) {
            return model.integrate(to_vector(q, model), to_vector(dv, model, "dv"));
          },
          docs::model_integrate, py::arg("q"), py::arg("dv"))
      .def(
          "difference",
          [](const Model& model, const Coordinates& q0, const Coordinates& q1) {
            return model.difference(to_vector(q0, model, "q0"), to_vector(q1, model, "q1"));
          },
          docs::model_difference, py::arg("q0"), py::arg("q1"))
      .def("normalized", &Model::normalized, docs::model_normalized, py::arg("q"))
      .def(
          "random_configuration",
          [](const Model& model, const py::object& random) {
            std::mt19937_64 bits(to_seed(random));
            return model.random_configuration(bits);
          },
          docs::model_random, py::arg("random") = py::none());
}

}  // namespace saltus::bindings
