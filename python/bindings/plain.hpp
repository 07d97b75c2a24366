// Values as plain Python data and back: dicts of a struct's fields by name, lists, texts, numbers,
// and arrays of what is long. Files and pickles are made of it.
//
// Fields<T> says which fields a struct has; the build fails where it lacks one.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.hpp"

namespace saltus::bindings {

/// A piece of plain data, and where it is: `links[2].inertia.mass`.
struct Part {
  py::handle value;
  std::string path;
  int version;  ///< of the description that it is of

  /// @throws ModelError "<path> <what>"
  [[noreturn]] void refuse(const std::string& what) const;
  /// "... is 'x'; it is a <wanted>"
  [[noreturn]] void refuse_kind(const std::string& wanted) const;
  Part item(const py::handle& inner, py::ssize_t index) const;
  Part field(const py::handle& inner, const std::string& name) const;
  py::dict dict() const;
  /// Of `count` items; -1: of any.
  py::list list(py::ssize_t count = -1) const;
  /// What a dict holds under a name. @throws ModelError where it has no such.
  Part at(const char* name) const;
};

template <class T>
struct Plain;  ///< static to(const T&) -> py::object and from(const Part&) -> T

template <class T, class V>
struct Field {
  const char* name;
  V T::* member;
  int since = 1;  ///< descriptions of older versions have it not: it is then as in T{}
};
template <class T, class V>
Field(const char*, V T::*) -> Field<T, V>;
template <class T, class V>
Field(const char*, V T::*, int) -> Field<T, V>;

template <class T>
struct Fields;  ///< static constexpr std::tuple all{Field...}

/// An aggregate's number of fields: how many things that can become anything it is made of.
struct Anything {
  template <class T>
  operator T() const;
};
template <class T, class... Some>
constexpr std::size_t count_fields() {
  if constexpr (requires { T{Some{}..., Anything{}}; }) {
    return count_fields<T, Some..., Anything>();
  } else {
    return sizeof...(Some);
  }
}

template <class T>
  requires requires { Fields<T>::all; }
struct Plain<T> {
  static constexpr auto& all = Fields<T>::all;
  static_assert(std::tuple_size_v<std::decay_t<decltype(Fields<T>::all)>> == count_fields<T>(),
                "Fields<T> has not all fields of T: files would lose them");

  static py::object to(const T& x) {
    py::dict out;
    write(x, out);
    return out;
  }
  static void write(const T& x, py::dict& out) {
    const auto one = [&]<class V>(const Field<T, V>& field) {
      out[field.name] = Plain<V>::to(x.*field.member);
    };
    std::apply([&](const auto&... field) { (one(field), ...); }, all);
  }
  static T from(const Part& part) {
    T x{};
    read(part, x, 0);
    return x;
  }
  /// `others`: entries of the dict that are no fields
  static void read(const Part& part, T& x, std::size_t others) {
    const py::dict given = part.dict();
    std::size_t known = others;
    const auto one = [&]<class V>(const Field<T, V>& field) {
      const bool is_there = given.contains(field.name);
      if (!is_there && field.since > part.version) return;
      x.*field.member = Plain<V>::from(part.at(field.name));
      ++known;
    };
    std::apply([&](const auto&... field) { (one(field), ...); }, all);
    if (known != given.size()) refuse_others(part, given);
  }

 private:
  [[noreturn]] static void refuse_others(const Part& part, const py::dict& given) {
    for (const auto& [name, value] : given) {
      const auto text = py::str(name).cast<std::string>();
      bool is_known = text == "kind";
      std::apply([&](const auto&... field) { ((is_known = is_known || text == field.name), ...); },
                 all);
      if (!is_known) part.refuse("has \"" + text + "\", which is not known");
    }
    part.refuse("has entries that are not known");
  }
};

template <>
struct Plain<double> {  ///< infinity: also "inf", "-inf"
  static py::object to(double x) { return py::float_(x); }
  static double from(const Part& part);
};
template <>
struct Plain<std::string> {
  static py::object to(const std::string& x) { return py::str(x); }
  static std::string from(const Part& part);
};

template <class Enum>
  requires std::is_enum_v<Enum>
struct Plain<Enum> {  ///< the member's name
  static py::object to(Enum x) { return py::cast(x).attr("name"); }
  static Enum from(const Part& part) {
    const auto name = Plain<std::string>::from(part);
    const py::dict members(py::type::of(py::cast(Enum{})).attr("__members__"));
    if (members.contains(name)) return members[name.c_str()].template cast<Enum>();
    part.refuse("is \"" + name + "\"; there are " +
                list_names(py::list(members).cast<std::vector<std::string>>()));
  }
};
template <>
struct Plain<JointEffects> {  ///< names of what acts
  static py::object to(JointEffects x);
  static JointEffects from(const Part& part);
};

template <int rows, int columns>
struct Plain<Eigen::Matrix<double, rows, columns>> {  ///< a list, of rows where there are several
  using Matrix = Eigen::Matrix<double, rows, columns>;
  static py::object to(const Matrix& x) { return py::cast(x).attr("tolist")(); }
  static Matrix from(const Part& part) {
    Matrix x;
    const py::list list = part.list(rows);
    for (int i = 0; i < rows; ++i) {
      const Part row = part.item(list[i], i);
      if constexpr (columns == 1) {
        x[i] = Plain<double>::from(row);
      } else {
        const py::list numbers = row.list(columns);
        for (int k = 0; k < columns; ++k) {
          x(i, k) = Plain<double>::from(row.item(numbers[k], k));
        }
      }
    }
    return x;
  }
};

template <class T>
struct Plain<std::optional<T>> {
  static py::object to(const std::optional<T>& x) {
    return x ? Plain<T>::to(*x) : py::object(py::none());
  }
  static std::optional<T> from(const Part& part) {
    if (part.value.is_none()) return {};
    return Plain<T>::from(part);
  }
};

template <class T>
struct Plain<std::vector<T>> {
  static py::object to(const std::vector<T>& items) {
    py::list list;
    for (const T& item : items) list.append(Plain<T>::to(item));
    return list;
  }
  static std::vector<T> from(const Part& part) {
    std::vector<T> items;
    py::ssize_t i = 0;
    for (const py::handle item : part.list()) items.push_back(Plain<T>::from(part.item(item, i++)));
    return items;
  }
};

template <class T, std::size_t n>
struct Plain<std::array<T, n>> {
  static py::object to(const std::array<T, n>& items) {
    return Plain<std::vector<T>>::to({items.begin(), items.end()});
  }
  static std::array<T, n> from(const Part& part) {
    part.list(n);
    const std::vector<T> items = Plain<std::vector<T>>::from(part);
    std::array<T, n> out;
    std::copy(items.begin(), items.end(), out.begin());
    return out;
  }
};

template <class A, class B>
struct Plain<std::pair<A, B>> {
  static py::object to(const std::pair<A, B>& x) {
    py::list list;
    list.append(Plain<A>::to(x.first));
    list.append(Plain<B>::to(x.second));
    return list;
  }
  static std::pair<A, B> from(const Part& part) {
    const py::list list = part.list(2);
    return {Plain<A>::from(part.item(list[0], 0)), Plain<B>::from(part.item(list[1], 1))};
  }
};

template <class Key, class T>
struct Plain<std::map<Key, T>> {  ///< a list of pairs: keys of two texts are no keys of a dict
  using Pairs = std::vector<std::pair<Key, T>>;
  static py::object to(const std::map<Key, T>& items) {
    return Plain<Pairs>::to({items.begin(), items.end()});
  }
  static std::map<Key, T> from(const Part& part) {
    const Pairs pairs = Plain<Pairs>::from(part);
    std::map<Key, T> out(pairs.begin(), pairs.end());
    if (out.size() != pairs.size()) part.refuse("has an entry twice");
    return out;
  }
};

/// Of structs with a name: their fields and their "kind".
template <class... Kinds>
struct Plain<std::variant<Kinds...>> {
  using Variant = std::variant<Kinds...>;
  static py::object to(const Variant& x) {
    return std::visit(
        []<class T>(const T& kind) -> py::object {
          py::dict out;
          out["kind"] = T::name;
          Plain<T>::write(kind, out);
          return out;
        },
        x);
  }
  static Variant from(const Part& part) {
    const Part kind = part.at("kind");
    const auto name = Plain<std::string>::from(kind);
    std::optional<Variant> out;
    const auto one = [&]<class T>(std::type_identity<T>) {
      if (name != T::name) return;
      T x{};
      Plain<T>::read(part, x, 1);
      out = x;
    };
    (one(std::type_identity<Kinds>{}), ...);
    if (out) return *std::move(out);
    kind.refuse("is \"" + name + "\"; there are " + list_names({Kinds::name...}));
  }
};

}  // namespace saltus::bindings
