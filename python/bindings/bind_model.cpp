// Model floor: the frozen model and its states.
#include <pybind11/native_enum.h>

#include "bindings.hpp"
#include "model_docs.hpp"
#include "pickle.hpp"
#include "saltus/model/model_builder.hpp"
#include "words.hpp"

namespace saltus::bindings {
namespace {

std::string show_state(const State& s) {
  const auto list = [](const VecX& x) {
    return py::str(py::cast(x).attr("tolist")()).cast<std::string>();
  };
  return "State(t=" + py::repr(py::float_(s.t)).cast<std::string>() + ", q=" + list(s.q) +
         ", p=" + list(s.p) + ")";
}

void bind_state(py::module_& m) {
  py::class_<State>(m, "State", docs::state)
      .def(py::init([](double t, const VecX& q, const VecX& p) { return State{t, q, p}; }),
           py::arg("t"), py::arg("q"), py::arg("p"))
      .def_readonly("t", &State::t, "[s]")
      .def_readonly("q", &State::q, "[rad | m] coordinates, shape (n_q,)")
      .def_readonly("p", &State::p, "[kg m^2/s | kg m/s] conjugate momenta, shape (n_v,)")
      .def("__eq__",
           [](const State& self, const py::object& other) {
             return py::isinstance<State>(other) && self == other.cast<const State&>();
           })
      .def("__copy__", [](const State& s) { return s; })
      .def(
          "__deepcopy__", [](const State& s, const py::object&) { return s; }, py::arg("memo"))
      .def("__repr__", [](const State& s) { return without_tails(show_state(s)); })
      .def(py::pickle([](const State& s) -> py::tuple { return py::make_tuple(s.t, s.q, s.p); },
                      [](const py::tuple& t) {
                        return State{t[0].cast<double>(), t[1].cast<VecX>(), t[2].cast<VecX>()};
                      }));
}

void bind_parts(py::module_& m) {
  py::native_enum<JointType>(m, "JointType", "enum.Enum", docs::joint_type)
      .value("fixed", JointType::fixed)
      .value("revolute", JointType::revolute)
      .value("continuous", JointType::continuous)
      .value("prismatic", JointType::prismatic)
      .value("helical", JointType::helical)
      .value("planar", JointType::planar)
      .value("floating", JointType::floating)
      .value("spherical", JointType::spherical)
      .finalize();
}

void bind_tree_solution(py::module_& m) {
  using S = TreeSolution;
  py::class_<S>(m, "TreeSolution", docs::tree_solution)
      .def_readonly("solver", &S::solver, "TreeSolver.lu or TreeSolver.sweep")
      .def_readonly("trees", &S::trees, "equal ones in lanes; 1: this tree alone")
      .def_readonly("joints", &S::joints, "of one coordinate each, of one tree")
      .def_readonly("depth", &S::depth, "joints on the longest path from the root")
      .def("__repr__", [](const S& s) {
        return "TreeSolution(" + py::cast(s.solver).attr("name").cast<std::string>() +
               ", trees=" + std::to_string(s.trees) + ", joints=" + std::to_string(s.joints) +
               ", depth=" + std::to_string(s.depth) + ")";
      });
}

void bind_gaps(py::module_& m) {
  py::class_<Gaps>(m, "Gaps", docs::gaps)
      .def_readonly("names", &Gaps::names, "\"a ~ b\", m of them")
      .def_readonly("phi", &Gaps::phi, "[m] shape (m,)")
      .def_readonly("phi_q", &Gaps::phi_q, "[m/rad | 1] shape (m, n_v)")
      .def_readonly("phi_qq", &Gaps::phi_qq, "m arrays of shape (n_v, n_v)")
      .def_readonly("normal", &Gaps::normal, "unit normals from b to a, shape (m, 3)")
      .def_readonly("p_WA", &Gaps::p_WA, "[m] witnesses on a, shape (m, 3)")
      .def_readonly("p_WB", &Gaps::p_WB, "[m] witnesses on b, shape (m, 3)")
      .def("__len__", [](const Gaps& g) { return g.phi.size(); })
      .def("__repr__", [](const Gaps& g) { return "Gaps(" + counted(g.phi.size(), "pair") + ")"; });
}

/// Lists are for people and small models.
void check_listable(const Model& model) {
  constexpr int most = 1'000'000;
  if (model->pairs.size() <= most) return;
  throw ModelError("the model has " + std::to_string(model->pairs.size()) +
                   " pairs, too many for a list; pair(k) and pair_name(k) give one of them");
}

std::vector<std::string> pair_names(const Model& model) {
  check_listable(model);
  std::vector<std::string> names;
  for (int i = 0; i < model->pairs.size(); ++i) names.push_back(model.pair_name(i));
  return names;
}

std::vector<Pair> pairs(const Model& model) {
  check_listable(model);
  std::vector<Pair> list;
  for (int i = 0; i < model->pairs.size(); ++i) list.push_back(model.pair(i));
  return list;
}

void bind_words(py::class_<Model>& c) {
  c.def("__repr__",
        [](const Model& m) {
          return "Model('" + m->name + "', " + counted(m.n_q(), "coordinate") + ", " +
                 (m.n_v() == m.n_q() ? "" : counted(m.n_v(), "velocity") + ", ") +
                 counted(static_cast<long>(m->shapes.size()), "shape") + ", " +
                 counted(m->pairs.size(), "pair") + ")";
        })
      .def("__str__", [](const py::object& self) { return in_words("models", "printed", self); })
      .def("_repr_html_",
           [](const py::object& self) { return in_words("models", "as_html", self); });
}

void bind_lists(py::class_<Model>& c) {
  bind_words(c);
  c.def_property_readonly("name", [](const Model& m) { return m->name; })
      .def_property_readonly("n_q", &Model::n_q, "numbers in q: a ball joint has four")
      .def_property_readonly("n_v", &Model::n_v, "numbers in v and p: a ball joint has three")
      .def_property_readonly(
          "gravity", [](const Model& m) { return m->mass.gravity; }, "[m/s^2] shape (3,)")
      .def_property_readonly(
          "source", [](const Model& m) { return m->source; },
          "the URDF text it was read from, \"\" for a model built in code")
      .def_property_readonly(
          "warnings", [](const Model& m) { return m->warnings; },
          "what was understood but is not used")
      .def_property_readonly("links", [](const Model& m) -> const auto& { return m->links; })
      .def_property_readonly("joints", [](const Model& m) -> const auto& { return m->joints; })
      .def_property_readonly("coordinates",
                             [](const Model& m) -> const auto& { return m->coordinates; })
      .def_property_readonly("shapes", [](const Model& m) -> const auto& { return m->shapes; })
      .def_property_readonly("visuals", &Model::visuals, "what its links look like, for pictures")
      .def_property_readonly("pairs", &pairs, "a list of the pairs; at most 10^6 of them")
      .def_property_readonly(
          "n_pairs", [](const Model& m) { return m->pairs.size(); }, "number of pairs")
      .def_property_readonly("link_names", [](const Model& m) { return names_of(m->links); })
      .def_property_readonly("joint_names", [](const Model& m) { return names_of(m->joints); })
      .def_property_readonly("coordinate_names",
                             [](const Model& m) { return names_of(m->coordinates); })
      .def_property_readonly("velocity_names", [](const Model& m) { return m->velocity_names; })
      .def_property_readonly("pair_names", &pair_names,
                             "\"a ~ b\" of every pair, \"a[part] ~ b\" where shapes have several")
      .def("pair", &Model::pair, py::arg("pair"),
           "The pair of this number, from 0 to `n_pairs` - 1.")
      .def("pair_name", &Model::pair_name, py::arg("pair"), "Its name.")
      .def("contact_properties", &Model::contact_properties, py::arg("pair"),
           "ContactProperties of the materials that meet in the pair of this number.")
      .def_property_readonly(
          "default_contact", [](const Model& m) { return m->description->materials.standard; },
          "ContactProperties of all pairs that nothing else is said of; None where nothing is said")
      .def("pair_kinds", &Model::pair_kinds,
           "How many pairs there are of each two kinds of shape, by their names in alphabetical "
           "order.")
      .def_property_readonly("solvers", &Model::solvers, "TreeSolutions: how its trees are solved")
      .def("coordinate", &Model::coordinate, py::arg("name"),
           "Index of a coordinate in q; ModelError with the names there are.")
      .def("velocity_index", &Model::velocity_index, py::arg("name"),
           "Index of a velocity in v and p; ModelError with the names there are.")
      .def(
          "link", [](const Model& m, const std::string& name) { return m->links[m.link(name)]; },
          py::arg("name"), "The Link of this name; ModelError with the names there are.")
      .def(
          "joint", [](const Model& m, const std::string& name) { return m->joints[m.joint(name)]; },
          py::arg("name"), "The JointInfo of this name; ModelError with the names there are.")
      .def("without_collisions", &Model::without_collisions,
           "A copy without any pair: bodies pass through each other.");
}

constexpr auto contact_properties_doc = R"(What happens where two materials meet.

Parameters
----------
restitution : float
    e in [0, 1]: a contact that closes with gap rate u < 0 opens with -e u.
friction : float
    Coulomb's mu >= 0.

Raises
------
ModelError
    On values out of their range.
)";

void bind_contact_properties(py::module_& m) {
  using P = ContactProperties;
  py::class_<P>(m, "ContactProperties", contact_properties_doc)
      .def(py::init([](double restitution, double friction) {
             const P properties{restitution, friction};
             check_properties(properties, "two bodies");
             return properties;
           }),
           py::kw_only(), py::arg("restitution") = P{}.restitution,
           py::arg("friction") = P{}.friction)
      .def_readonly("restitution", &P::restitution)
      .def_readonly("friction", &P::friction)
      .def(
          "__eq__", [](const P& a, const P& b) { return a == b; }, py::arg("other"),
          py::is_operator())
      .def("__repr__",
           [](const P& p) {
             return "ContactProperties(restitution=" +
                    py::repr(py::float_(p.restitution)).cast<std::string>() +
                    ", friction=" + py::repr(py::float_(p.friction)).cast<std::string>() + ")";
           })
      .def(pickle_fields<P, &P::restitution, &P::friction>());
}

void bind_copies(py::class_<Model>& c) {
  c.def("__copy__", [](const Model& m) {
     return m;
   }).def("__deepcopy__", [](const Model& m, const py::object&) { return m; }, py::arg("memo"));
}

using PartialsOrNone = py::typing::Optional<LagrangianPartials>;

// New ones belong to the caller; of `out` pybind11 finds the object that it is.
LagrangianPartials* lagrangian_into(const Model& model, const Coordinates& q, const Velocities& v,
                                    const PartialsOrNone& out) {
  if (out.is_none()) {
    return new LagrangianPartials(model.lagrangian(to_vector(q, model), to_vector(v, model)));
  }
  if (!py::isinstance<LagrangianPartials>(out)) {
    throw py::type_error("out is " + py::repr(py::type::of(out)).cast<std::string>() +
                         "; it is LagrangianPartials of an earlier call");
  }
  auto* partials = out.cast<LagrangianPartials*>();
  if (partials->L_v.size() != model.n_v()) {  // its arrays may be seen, so they stay where they are
    throw ModelError("out has partials of n = " + std::to_string(partials->L_v.size()) +
                     "; this model has n_v = " + std::to_string(model.n_v()));
  }
  model.lagrangian(to_vector(q, model), to_vector(v, model), *partials);
  return partials;
}

}  // namespace

void bind_model(py::module_& m) {
  bind_contact_properties(m);
  bind_joint_effects(m);
  bind_loop_types(m);
  bind_state(m);
  bind_parts(m);
  bind_links(m);
  bind_tree_solution(m);
  bind_gaps(m);
  bind_visuals(m);
  bind_sensors(m);
  py::class_<Model> c(m, "Model", docs::model);
  bind_lists(c);
  bind_copies(c);
  bind_descriptions(c, m);
  bind_model_sensors(c);
  bind_configurations(c);
  bind_model_forces(c);
  bind_model_loops(c, m);
  c.def(
       "state",
       [](const Model& model, const Coordinates& q, const Velocities& v, double t) {
         const bool is_named = py::isinstance<py::str>(q.value) && v.value.is_none();
         return model.state(to_vector(q, model),
                            to_vector(is_named ? Velocities{q.value} : v, model), t);
       },
       docs::model_state, py::arg("q") = py::none(), py::arg("v") = py::none(), py::arg("t") = 0.0)
      .def("velocity", &Model::velocity, docs::model_velocity, py::arg("state"))
      .def("lagrangian", &lagrangian_into, docs::model_lagrangian, py::arg("q"), py::arg("v"),
           py::kw_only(), py::arg("out") = py::none(), py::return_value_policy::take_ownership)
      .def(
          "mass_matrix",
          [](const Model& model, const Coordinates& q) {
            return model.mass_matrix(to_vector(q, model));
          },
          docs::model_mass_matrix, py::arg("q"))
      .def(
          "gaps",
          [](const Model& model, const Coordinates& q) { return model.gaps(to_vector(q, model)); },
          docs::model_gaps, py::arg("q"))
      .def("kinetic_energy", &Model::kinetic_energy, "[J] at this state.", py::arg("state"))
      .def(
          "potential_energy",
          [](const Model& model, const Coordinates& q) {
            return model.potential_energy(to_vector(q, model));
          },
          "[J] of gravity, zero at the world's origin, and of springs and potentials.",
          py::arg("q"))
      .def(
          "pose",
          [](const Model& model, const Coordinates& q, const NameOrLink& link) {
            const auto item = py::reinterpret_borrow<NameOrIndex>(link);
            return model.X_WL(to_vector(q, model), to_index(item, names_of(model->links), "link"));
          },
          docs::model_pose, py::arg("q"), py::arg("link"));
}

}  // namespace saltus::bindings
