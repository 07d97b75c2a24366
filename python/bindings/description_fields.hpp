// The fields of all that a model is built of, by the names that files have.
//
// A new kind of element takes a Fields<...> here and an entry in those of ModelDescription, both
// with the next `description_version` as the version that they are known since.
#pragma once

#include "plain.hpp"
#include "saltus/model/description.hpp"

namespace saltus::bindings {

inline constexpr int description_version = 1;

template <>
struct Fields<Pose> {
  static constexpr std::tuple all{Field{"R", &Pose::R}, Field{"p", &Pose::p}};
};
template <>
struct Fields<BodyInertia> {
  using T = BodyInertia;
  static constexpr std::tuple all{Field{"mass", &T::mass}, Field{"c_J", &T::c_J},
                                  Field{"I_J", &T::I_J}};
};
template <>
struct Fields<LinkSpec> {
  using T = LinkSpec;
  static constexpr std::tuple all{Field{"name", &T::name}, Field{"inertia", &T::inertia},
                                  Field{"check", &T::check},
                                  Field{"compensation", &T::compensation}};
};
template <>
struct Fields<Mimic> {
  using T = Mimic;
  static constexpr std::tuple all{Field{"joint", &T::joint}, Field{"multiplier", &T::multiplier},
                                  Field{"offset", &T::offset}};
};
template <>
struct Fields<JointSpec> {
  using T = JointSpec;
  static constexpr std::tuple all{Field{"name", &T::name},
                                  Field{"type", &T::type},
                                  Field{"parent", &T::parent},
                                  Field{"child", &T::child},
                                  Field{"X_PJ", &T::X_PJ},
                                  Field{"axis", &T::axis},
                                  Field{"pitch", &T::pitch},
                                  Field{"mimic", &T::mimic},
                                  Field{"lower", &T::lower},
                                  Field{"upper", &T::upper},
                                  Field{"velocity", &T::velocity},
                                  Field{"effort", &T::effort},
                                  Field{"damping", &T::damping},
                                  Field{"friction", &T::friction},
                                  Field{"armature", &T::armature},
                                  Field{"stiffness", &T::stiffness},
                                  Field{"rest", &T::rest},
                                  Field{"limit_restitution", &T::limit_restitution},
                                  Field{"curve_x", &T::curve_x},
                                  Field{"curve_f", &T::curve_f},
                                  Field{"curve_slopes", &T::curve_slopes},
                                  Field{"effects", &T::effects}};
};
template <>
struct Fields<ActuatorSpec> {
  using T = ActuatorSpec;
  static constexpr std::tuple all{
      Field{"name", &T::name},     Field{"joints", &T::joints}, Field{"gain", &T::gain},
      Field{"bias", &T::bias},     Field{"bias_l", &T::bias_l}, Field{"bias_v", &T::bias_v},
      Field{"effort", &T::effort}, Field{"lower", &T::lower},   Field{"upper", &T::upper}};
};
template <>
struct Fields<At> {
  static constexpr std::tuple all{Field{"link", &At::link}, Field{"X_LA", &At::X_LA}};
};
template <>
struct Fields<SpringSpec> {
  using T = SpringSpec;
  static constexpr std::tuple all{Field{"name", &T::name},     Field{"a", &T::a},
                                  Field{"b", &T::b},           Field{"stiffness", &T::stiffness},
                                  Field{"length", &T::length}, Field{"damping", &T::damping}};
};
/// A function is told by its name alone, and cannot be read again.
template <class T>
struct PlainFunction {
  static py::object to(const T& x) {
    py::dict out;
    out["name"] = x.name;
    return out;
  }
  static T from(const Part& part) {
    part.refuse("\"" + Plain<std::string>::from(part.at("name")) +
                "\" was a function, which cannot be kept; build the model anew");
  }
};
template <>
struct Plain<ForceSpec> : PlainFunction<ForceSpec> {};
template <>
struct Plain<std::function<PrescribedMotion(double)>> {  ///< true where there is one
  using Function = std::function<PrescribedMotion(double)>;
  static py::object to(const Function& x) { return py::bool_(static_cast<bool>(x)); }
  static Function from(const Part& part) {
    if (!part.value.cast<bool>()) return {};
    part.refuse("was a function, which cannot be kept; build the model anew");
  }
};
template <>
struct Fields<PrescribedSpec> {
  using T = PrescribedSpec;
  static constexpr std::tuple all{Field{"joint", &T::joint}, Field{"times", &T::times},
                                  Field{"values", &T::values}, Field{"function", &T::function}};
};
template <>
struct Plain<PotentialFunction> : PlainFunction<PotentialFunction> {};
template <>
struct Fields<LoopSpec> {
  using T = LoopSpec;
  static constexpr std::tuple all{Field{"name", &T::name}, Field{"type", &T::type},
                                  Field{"a", &T::a}, Field{"b", &T::b},
                                  Field{"distance", &T::distance}};
};
template <>
struct Fields<CouplingSpec> {
  using T = CouplingSpec;
  static constexpr std::tuple all{Field{"joint", &T::joint}, Field{"of", &T::of},
                                  Field{"polynomial", &T::polynomial}};
};

template <>
struct Fields<Sphere> {
  static constexpr std::tuple all{Field{"radius", &Sphere::radius}};
};
template <>
struct Fields<Capsule> {
  static constexpr std::tuple all{Field{"radius", &Capsule::radius},
                                  Field{"half_length", &Capsule::half_length}};
};
template <>
struct Fields<Box> {
  static constexpr std::tuple all{Field{"half", &Box::half}};
};
template <>
struct Fields<Cylinder> {
  static constexpr std::tuple all{Field{"radius", &Cylinder::radius},
                                  Field{"half_length", &Cylinder::half_length}};
};
template <>
struct Fields<HalfSpace> {
  static constexpr std::tuple<> all{};
};
template <>
struct Fields<Ellipsoid> {
  static constexpr std::tuple all{Field{"radii", &Ellipsoid::radii}};
};
/// A hull with its faces and edges, which points alone could give in another order.
template <>
struct Plain<Convex> {
  static void write(const Convex& x, py::dict& out);
  static void read(const Part& part, Convex& x, std::size_t others);
};
template <>
struct Plain<TriangleMesh> {
  static void write(const TriangleMesh& x, py::dict& out);
  static void read(const Part& part, TriangleMesh& x, std::size_t others);
};
using Looks = std::variant<Shape, TriangleMesh>;
template <>
struct Plain<Looks> {
  static py::object to(const Looks& x);
  static Looks from(const Part& part);
};

template <>
struct Fields<ContactProperties> {
  using T = ContactProperties;
  static constexpr std::tuple all{Field{"restitution", &T::restitution},
                                  Field{"friction", &T::friction}};
};
template <>
struct Fields<ShapeSpec> {
  using T = ShapeSpec;
  static constexpr std::tuple all{Field{"link", &T::link},         Field{"name", &T::name},
                                  Field{"shape", &T::shape},       Field{"X_LG", &T::X_LG},
                                  Field{"material", &T::material}, Field{"contact", &T::contact}};
};
template <>
struct Fields<Visual> {
  using T = Visual;
  static constexpr std::tuple all{Field{"link", &T::link}, Field{"shape", &T::shape},
                                  Field{"X_LG", &T::X_LG}, Field{"rgba", &T::rgba},
                                  Field{"name", &T::name}};
};
template <>
struct Fields<FilterSpec> {
  using T = FilterSpec;
  static constexpr std::tuple all{Field{"links", &T::links}, Field{"bodies", &T::bodies},
                                  Field{"groups", &T::groups}, Field{"group_of", &T::group_of},
                                  Field{"adjacent", &T::adjacent}};
};
template <>
struct Fields<MaterialSpec> {
  using T = MaterialSpec;
  static constexpr std::tuple all{Field{"of_link", &T::of_link}, Field{"contact", &T::contact},
                                  Field{"standard", &T::standard}};
};
template <>
struct Fields<StateSpec> {
  using T = StateSpec;
  static constexpr std::tuple all{Field{"name", &T::name}, Field{"q", &T::q}, Field{"v", &T::v}};
};
template <>
struct Fields<SensorSpec> {
  using T = SensorSpec;
  static constexpr std::tuple all{Field{"name", &T::name}, Field{"kind", &T::kind},
                                  Field{"of", &T::of}, Field{"other", &T::other},
                                  Field{"X_LS", &T::X_LS}};
};
template <>
struct Fields<ModelDescription> {
  using T = ModelDescription;
  static constexpr std::tuple all{Field{"name", &T::name},
                                  Field{"root", &T::root},
                                  Field{"source", &T::source},
                                  Field{"gravity", &T::gravity},
                                  Field{"solver", &T::solver},
                                  Field{"links", &T::links},
                                  Field{"joints", &T::joints},
                                  Field{"actuators", &T::actuators},
                                  Field{"shapes", &T::shapes},
                                  Field{"visuals", &T::visuals},
                                  Field{"filter", &T::filter},
                                  Field{"materials", &T::materials},
                                  Field{"states", &T::states},
                                  Field{"sensors", &T::sensors},
                                  Field{"springs", &T::springs},
                                  Field{"forces", &T::forces},
                                  Field{"potentials", &T::potentials},
                                  Field{"loops", &T::loops},
                                  Field{"couplings", &T::couplings},
                                  Field{"prescribed", &T::prescribed},
                                  Field{"warnings", &T::warnings}};
};

}  // namespace saltus::bindings
