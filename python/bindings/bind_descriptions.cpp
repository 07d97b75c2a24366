// Model floor: what a model is built of, as plain data, for files.
#include "bindings.hpp"
#include "description_fields.hpp"
#include "pickle.hpp"

namespace saltus::bindings {
namespace {

/// @throws TypeError where the model has functions
void check_no_functions(const ModelDescription& d) {
  const auto refuse = [&](const std::string& what) {
    throw py::type_error("cannot pickle model '" + d.name + "': its " + what +
                         " is a function; build it where it is needed, or pickle a model without");
  };
  if (!d.forces.empty()) refuse("force '" + d.forces.front().name + "'");
  for (const PrescribedSpec& spec : d.prescribed) {
    if (spec.function) refuse("prescribed motion of '" + spec.joint + "'");
  }
  if (!d.potentials.empty()) refuse("potential '" + d.potentials.front().name + "'");
}

}  // namespace

void bind_descriptions(py::class_<Model>& c, py::module_& m) {
  m.attr("_DESCRIPTION_VERSION") = description_version;
  c.def(
       "_description", [](const Model& model) { return to_plain(*model->description); },
       "All that the model is built of, as plain data: dicts by name, lists, numbers, arrays.")
      .def_static(
          "_of_description",
          [](const py::dict& description, bool collisions, int version) {
            const Model whole = ModelBuilder(to_description(description, version)).build();
            return collisions ? whole : whole.without_collisions();
          },
          "The model of `_description`; ModelError with the place of what is wrong in it.",
          py::arg("description"), py::kw_only(), py::arg("collisions") = true,
          py::arg("version") = description_version)
      .def(py::pickle(
          [](const Model& model) -> py::tuple {
            check_no_functions(*model->description);
            return py::make_tuple(to_plain(*model->description), !model->pairs.empty());
          },
          [](const py::tuple& t) {
            const Model whole =
                ModelBuilder(to_description(t[0].cast<py::dict>(), description_version)).build();
            return t[1].cast<bool>() ? whole : whole.without_collisions();
          }));
}

}  // namespace saltus::bindings
