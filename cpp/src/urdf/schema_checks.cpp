#include <algorithm>
#include <cmath>

#include "saltus/model/model.hpp"
#include "urdf/checks.hpp"
#include "urdf/numbers.hpp"
#include "urdf/schema.hpp"
#include "urdf/shape_elements.hpp"

namespace saltus::reader {
namespace {

/// By append: GCC 12 warns of what it makes of `"<" + name`.
std::string in_tag(const std::string& name) {
  std::string text;
  return text.append("<").append(name).append(">");
}

/// Walks an element and its schema side by side.
class SchemaCheck {
 public:
  SchemaCheck(const Document& document, Warnings& warnings)
      : document_(document), warnings_(warnings) {}

  void check(const XMLElement& element, const ElementRule& rule, const Owner& owner) {
    for (const TextRule& text : rule.texts) {
      if (text.required) check_given(element, text.name, owner);
      check_no_xacro(element, text.name, owner);
    }
    for (const NumberRule& number : rule.numbers) {
      check_number(element, number, rule.strict, owner);
    }
    check_attributes_known(element, rule, owner);
    for (const ElementRule& child : rule.children) check_count(element, child, rule.strict, owner);
    for (auto e = element.FirstChildElement(); e; e = e->NextSiblingElement()) {
      check_child(element, *e, rule, owner);
    }
  }

 private:
  /// `has <origin rpy="0 0 0">` where the element is a part of its owner.
  static bool is_part(const XMLElement& element, const Owner& owner) {
    return element.Name() != owner.element;
  }

  /// `<mass> of link "arm"`
  static std::string subject(const XMLElement& element, const Owner& owner) {
    if (!is_part(element, owner)) return owner.show();
    return in_tag(element.Name()) + " of " + owner.show();
  }

  void check_given(const XMLElement& element, const char* name, const Owner& owner) const {
    if (!attribute(element, name).empty()) return;
    const std::string part =
        is_part(element, owner) ? "has <" + std::string(element.Name()) + "> " : "is ";
    document_.fail(element, owner, part + "without attribute " + in_quotes(name));
  }

  /// A name with an expression in it is a name; two copies of one robot then have the same.
  void check_no_xacro(const XMLElement& element, const char* name, const Owner& owner) {
    const std::string text = attribute(element, name);
    if (!has_xacro(text)) return;
    warnings_.add_flaw("xacro",
                       document_.at(element) + subject(element, owner) + " has " + name + "=" +
                           in_quotes(text) + ": " + xacro_expression,
                       "", owner);
  }

  void check_number(const XMLElement& element, const NumberRule& rule, bool strict,
                    const Owner& owner) {
    if (rule.required) check_given(element, rule.name, owner);
    const char* text = element.Attribute(rule.name);
    if (text == nullptr) return;
    const std::string shown = std::string(rule.name) + "=" + in_quotes(text);
    const std::string part =
        is_part(element, owner) ? in_tag(element.Name() + (" " + shown)) : shown;
    const auto fail = [&](const std::string& what) {
      document_.fail(element, owner, "has " + part + ": " + what);
    };
    const auto flaw = [&](const std::string& what, const std::string& reading) {
      if (strict) fail(what);
      warnings_.add_flaw(what, document_.at(element) + owner.show() + " has " + part + ": " + what,
                         "; " + reading, owner);
    };
    const Numbers numbers = parse_numbers(text);
    if (!numbers.bad.empty() && has_xacro(text)) fail(xacro_expression);
    if (!numbers.bad.empty()) fail(in_quotes(numbers.bad) + " is not a number");
    if (numbers.has_commas) flaw("numbers are separated by spaces", "commas are read as these");
    if (numbers.has_dots) flaw("a number ends with a second dot", "it is read without");
    check_how_many(numbers, rule, fail, flaw);
    for (const double value : numbers.values) {
      if (std::isnan(value) || (std::isinf(value) && !rule.may_be_infinite)) {
        fail(print_number(value) + " is not finite");
      }
      if (!rule.positive || value > 0) continue;
      if (value < 0) fail("a size must be positive");
      flaw("a size must be positive", "it is read as " + print_number(least_size) + " m");
    }
  }

  template <class Fail, class Flaw>
  static void check_how_many(const Numbers& numbers, const NumberRule& rule, const Fail& fail,
                             const Flaw& flaw) {
    const std::size_t count = numbers.values.size();
    if (count == rule.count) return;
    const std::string what = std::to_string(rule.count) +
                             (rule.count == 1 ? " number is" : " numbers are") + " needed, " +
                             std::to_string(count) + " given";
    // one, or decimal commas: the first are not what was meant
    if (count < rule.count || rule.count == 1 || numbers.has_commas) fail(what);
    flaw(what, "the first of them are read");
  }

  void check_attributes_known(const XMLElement& element, const ElementRule& rule,
                              const Owner& owner) {
    const std::vector<std::string> known = rule.attribute_names();
    std::vector<std::string> unknown;
    for (auto a = element.FirstAttribute(); a; a = a->Next()) {
      const std::string name = a->Name();
      const bool foreign = name.find(':') != std::string::npos || name == "xmlns";
      if (foreign || std::find(known.begin(), known.end(), name) != known.end()) continue;
      unknown.push_back(name);
    }
    if (unknown.empty()) return;
    const std::string what =
        unknown.size() == 1 ? " has an unknown attribute, " : " has unknown attributes, ";
    report_unknown(element, element, rule, owner, what + list_names(unknown), known);
  }

  void check_count(const XMLElement& element, const ElementRule& rule, bool strict,
                   const Owner& owner) {
    if (rule.occurs == Occurs::any) return;
    const XMLElement* first = element.FirstChildElement(rule.name);
    const std::string in =
        is_part(element, owner) ? " in <" + std::string(element.Name()) + ">" : "";
    const std::string shown = in_tag(rule.name) + in;
    if (first == nullptr) {
      if (rule.occurs == Occurs::once) document_.fail(element, owner, "has no " + shown);
      return;
    }
    if (const XMLElement* second = first->NextSiblingElement(rule.name)) {
      const std::string line = std::to_string(first->GetLineNum());
      const std::string what = "has a second " + shown + "; the first is in line " + line;
      if (strict) document_.fail(*second, owner, what);
      warnings_.add_flaw("second " + shown, document_.at(*second) + owner.show() + " " + what,
                         " and is used", owner);
    }
  }

  void check_child(const XMLElement& element, const XMLElement& child, const ElementRule& rule,
                   const Owner& owner) {
    const std::string name = child.Name();
    if (name.rfind("xacro:", 0) == 0) {
      document_.fail(child, owner,
                     "has <" + name + ">: this is a xacro file, which is to be " +
                         "expanded first: xacro FILE.xacro > FILE.urdf");
    }
    if (const ElementRule* known = rule.child(name)) {
      // below <robot> and <saltus> stand the things that have names
      const bool is_owner = owner.element == "robot" || owner.element == "saltus";
      check(child, *known, is_owner ? Owner{name, attribute(child, "name")} : owner);
      return;
    }
    const bool foreign = name.find(':') != std::string::npos;
    if (foreign || std::count(rule.skipped.begin(), rule.skipped.end(), name) > 0) return;
    report_unknown(element, child, rule, owner, " has an unknown element, <" + name + ">",
                   rule.child_names());
  }

  void report_unknown(const XMLElement& element, const XMLElement& where, const ElementRule& rule,
                      const Owner& owner, const std::string& what,
                      const std::vector<std::string>& known) {
    const std::string text = document_.at(where) + subject(element, owner) + what;
    const std::string alternatives =
        known.empty() ? "none is known here" : "known are " + list_names(known);
    if (rule.strict) throw ModelError(text + "; " + alternatives, owner.element, owner.name);
    warnings_.add(element.Name() + what, text + " (not used); " + alternatives);
  }

  const Document& document_;
  Warnings& warnings_;
};

}  // namespace

void check_schema(const Document& document, Warnings& warnings) {
  const XMLElement& robot = document.robot();
  SchemaCheck(document, warnings).check(robot, schema(), {"robot", attribute(robot, "name")});
}

}  // namespace saltus::reader
