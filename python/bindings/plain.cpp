#include "plain.hpp"

#include <cmath>
#include <limits>

#include "description_fields.hpp"
#include "pickle.hpp"

namespace saltus::bindings {

void Part::refuse(const std::string& what) const {
  throw ModelError((path.empty() ? "the description" : path) + " " + what);
}

void Part::refuse_kind(const std::string& wanted) const {
  const bool is_array = py::isinstance<py::array>(value);
  auto text = is_array ? "an array of " + py::str(value.attr("dtype")).cast<std::string>() +
                             ", shape " + py::str(value.attr("shape")).cast<std::string>()
                       : py::repr(value).cast<std::string>();
  if (text.size() > 60) text = text.substr(0, 60) + " ...";
  refuse("is " + text + "; it is " + wanted);
}

Part Part::item(const py::handle& inner, py::ssize_t index) const {
  return {inner, path + "[" + std::to_string(index) + "]", version};
}

Part Part::field(const py::handle& inner, const std::string& name) const {
  return {inner, path.empty() ? name : path + "." + name, version};
}

py::dict Part::dict() const {
  if (!py::isinstance<py::dict>(value)) refuse_kind("a group of fields by name");
  return py::reinterpret_borrow<py::dict>(value);
}

py::list Part::list(py::ssize_t count) const {
  if (!py::isinstance<py::list>(value)) refuse_kind("a list");
  auto list = py::reinterpret_borrow<py::list>(value);
  const auto size = static_cast<py::ssize_t>(list.size());
  if (count >= 0 && size != count) {
    refuse("has " + counted(size, "entry") + "; it has " + std::to_string(count));
  }
  return list;
}

Part Part::at(const char* name) const {
  const py::dict given = dict();
  if (!given.contains(name)) refuse("has no \"" + std::string(name) + "\"");
  return field(given[name], name);
}

double Plain<double>::from(const Part& part) {
  if (py::isinstance<py::str>(part.value)) {
    const auto text = part.value.cast<std::string>();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (text == "inf") return infinity;
    if (text == "-inf") return -infinity;
  }
  const bool is_number = py::isinstance<py::float_>(part.value) ||
                         (py::isinstance<py::int_>(part.value) && !PyBool_Check(part.value.ptr()));
  if (!is_number) part.refuse_kind("a number");
  const double x = PyFloat_AsDouble(part.value.ptr());
  if (PyErr_Occurred() != nullptr) {  // a whole number too great
    PyErr_Clear();
    part.refuse_kind("a number that a double can hold");
  }
  if (std::isnan(x)) part.refuse_kind("a number");
  return x;
}

std::string Plain<std::string>::from(const Part& part) {
  if (!py::isinstance<py::str>(part.value)) part.refuse_kind("a text");
  try {
    return part.value.cast<std::string>();
  } catch (const py::cast_error&) {  // half of a surrogate pair
    PyErr_Clear();
    part.refuse_kind("a text that can be written as UTF-8");
  }
}

namespace {

constexpr std::array effects{
    std::pair{"limits", JointEffects::limits}, std::pair{"damping", JointEffects::damping},
    std::pair{"friction", JointEffects::friction}, std::pair{"motors", JointEffects::motors}};

}  // namespace

py::object Plain<JointEffects>::to(JointEffects x) {
  py::list list;
  for (const auto& [name, effect] : effects) {
    if (has(x, effect)) list.append(py::str(name));
  }
  return list;
}

JointEffects Plain<JointEffects>::from(const Part& part) {
  JointEffects all = JointEffects::none;
  for (const std::string& given : Plain<std::vector<std::string>>::from(part)) {
    bool is_known = false;
    for (const auto& [name, effect] : effects) {
      if (given != name) continue;
      all = all | effect;
      is_known = true;
    }
    if (!is_known) {
      part.refuse("has \"" + given + "\"; there are limits, damping, friction, motors");
    }
  }
  return all;
}

namespace {

template <class T>
py::array_t<T> to_array(const std::vector<T>& x, py::ssize_t columns) {
  const auto size = static_cast<py::ssize_t>(x.size());
  if (columns == 1) return py::array_t<T>(size, x.data());
  return py::array_t<T>({size / columns, columns}, x.data());
}

/// All numbers of an array of so many columns. @throws ModelError on another shape or type.
template <class T>
std::vector<T> from_array(const Part& part, py::ssize_t columns) {
  const bool is_whole = std::is_integral_v<T>;
  const auto any = py::isinstance<py::array>(part.value)
                       ? py::reinterpret_borrow<py::array>(part.value)
                       : py::array();
  const bool fits = py::isinstance<py::array>(part.value) && any.ndim() == (columns == 1 ? 1 : 2) &&
                    (columns == 1 || any.shape(1) == columns);
  const char kind = any.dtype().kind();
  if (!fits || !(kind == 'i' || kind == 'u' || (kind == 'f' && !is_whole))) {
    part.refuse_kind("an array of " + std::string(is_whole ? "whole " : "") + "numbers, shape (n" +
                     (columns == 1 ? ",)" : ", " + std::to_string(columns) + ")"));
  }
  using Wide = std::conditional_t<std::is_integral_v<T>, std::int64_t, T>;
  const py::array_t<Wide, py::array::c_style | py::array::forcecast> array(any);
  std::vector<T> out;
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    const Wide x = array.data()[i];
    if (static_cast<Wide>(static_cast<T>(x)) != x && x == x) part.refuse("has a number too great");
    out.push_back(static_cast<T>(x));
  }
  return out;
}

std::vector<double> flat(const std::vector<Vec3>& points) {
  std::vector<double> out;
  for (const Vec3& x : points) out.insert(out.end(), x.begin(), x.end());
  return out;
}

std::vector<Vec3> points_of(const Part& part) {
  const std::vector<double> x = from_array<double>(part, 3);
  std::vector<Vec3> points(x.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = Vec3(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
  }
  return points;
}

std::vector<Hull::Face> faces_of(const Part& part) {
  const std::vector<Vec3> normals = points_of(part.at("normals"));
  const std::vector<double> offsets = from_array<double>(part.at("offsets"), 1);
  const std::vector<int> counts = from_array<int>(part.at("corner_counts"), 1);
  const std::vector<int> corners = from_array<int>(part.at("corners"), 1);
  if (offsets.size() != normals.size() || counts.size() != normals.size()) {
    part.refuse("has normals, offsets and corner_counts of different lengths");
  }
  std::vector<Hull::Face> faces;
  std::size_t first = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const auto count = static_cast<std::size_t>(std::max(counts[i], 0));
    if (counts[i] < 0 || count > corners.size() - first) {
      part.refuse("has corner_counts that are not those of its corners");
    }
    const auto at = corners.begin() + static_cast<std::ptrdiff_t>(first);
    faces.push_back({normals[i], offsets[i], {at, at + counts[i]}});
    first += count;
  }
  if (first != corners.size()) part.refuse("has corner_counts that are not those of its corners");
  return faces;
}

/// Whether the corners of each face lie in its plane; indices are checked before.
bool is_closed(const Hull& hull) {
  double size = 0;
  for (const Vec3& x : hull.vertices) size = std::max(size, x.cwiseAbs().maxCoeff());
  for (const Hull::Face& face : hull.faces) {
    for (const int corner : face.corners) {
      const double off = face.normal.dot(hull.vertices[static_cast<std::size_t>(corner)]);
      if (!(std::abs(off - face.offset) <= 1e-6 * size)) return false;
    }
  }
  return true;
}

}  // namespace

void Plain<Convex>::write(const Convex& x, py::dict& out) {
  const Hull& hull = *x.hull;
  std::vector<Vec3> normals;
  std::vector<double> offsets;
  std::vector<int> counts, corners, edges;
  for (const Hull::Face& face : hull.faces) {
    normals.push_back(face.normal);
    offsets.push_back(face.offset);
    counts.push_back(static_cast<int>(face.corners.size()));
    corners.insert(corners.end(), face.corners.begin(), face.corners.end());
  }
  for (const Hull::Edge& edge : hull.edges) {
    edges.insert(edges.end(), {edge.from, edge.to, edge.left, edge.right});
  }
  out["vertices"] = to_array(flat(hull.vertices), 3);
  out["normals"] = to_array(flat(normals), 3);
  out["offsets"] = to_array(offsets, 1);
  out["corner_counts"] = to_array(counts, 1);
  out["corners"] = to_array(corners, 1);
  out["edges"] = to_array(edges, 4);
  out["first_neighbour"] = to_array(hull.first_neighbour, 1);
  out["neighbour"] = to_array(hull.neighbour, 1);
  out["center"] = Plain<Vec3>::to(hull.center);
}

void Plain<Convex>::read(const Part& part, Convex& x, std::size_t others) {
  if (part.dict().size() != 9 + others) part.refuse("has not the nine entries of a convex");
  Hull hull;
  hull.vertices = points_of(part.at("vertices"));
  hull.faces = faces_of(part);
  const std::vector<int> edges = from_array<int>(part.at("edges"), 4);
  for (std::size_t i = 0; i + 3 < edges.size(); i += 4) {
    hull.edges.push_back({edges[i], edges[i + 1], edges[i + 2], edges[i + 3]});
  }
  hull.first_neighbour = from_array<int>(part.at("first_neighbour"), 1);
  hull.neighbour = from_array<int>(part.at("neighbour"), 1);
  hull.center = Plain<Vec3>::from(part.at("center"));
  x.hull = std::make_shared<const Hull>(std::move(hull));
  try {  // its indices, above all
    check_visual({"", x});
  } catch (const ModelError&) {
    part.refuse("is a convex whose parts do not fit together");
  }
  if (!is_closed(*x.hull)) part.refuse("is a convex whose corners are not on its faces");
}

void Plain<TriangleMesh>::write(const TriangleMesh& x, py::dict& out) {
  std::vector<int> corners;
  for (const auto& face : x.triangles->faces) {
    corners.insert(corners.end(), face.begin(), face.end());
  }
  out["vertices"] = to_array(flat(x.triangles->vertices), 3);
  out["faces"] = to_array(corners, 3);
}

void Plain<TriangleMesh>::read(const Part& part, TriangleMesh& x, std::size_t others) {
  if (part.dict().size() != 2 + others) part.refuse("has not the two entries of a mesh");
  Triangles triangles{points_of(part.at("vertices")), {}};
  const std::vector<int> corners = from_array<int>(part.at("faces"), 3);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    triangles.faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  x.triangles = std::make_shared<const Triangles>(std::move(triangles));
}

py::object Plain<Looks>::to(const Looks& x) {
  if (const auto* shape = std::get_if<Shape>(&x)) return Plain<Shape>::to(*shape);
  return Plain<std::variant<TriangleMesh>>::to(std::get<TriangleMesh>(x));
}

Looks Plain<Looks>::from(const Part& part) {
  const Part kind = part.at("kind");
  if (Plain<std::string>::from(kind) != TriangleMesh::name) return Plain<Shape>::from(part);
  return std::get<TriangleMesh>(Plain<std::variant<TriangleMesh>>::from(part));
}

py::dict to_plain(const ModelDescription& description) {
  return Plain<ModelDescription>::to(description);
}

ModelDescription to_description(const py::dict& plain, int version) {
  return ModelBuilder::checked(Plain<ModelDescription>::from({plain, "", version}));
}

}  // namespace saltus::bindings
