#include "urdf/srdf.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include "saltus/model/model.hpp"

namespace saltus::reader {

std::string given(const Document& document, const XMLElement& element, const char* name) {
  const std::string value = attribute(element, name);
  if (has_xacro(value)) {
    document.fail(element, {element.Name(), ""},
                  "has " + std::string(name) + "=" + in_quotes(value) + ": " + xacro_expression);
  }
  if (value.empty()) {
    document.fail(element, {element.Name(), ""}, "is without attribute " + in_quotes(name));
  }
  return value;
}

namespace {

using LinkPairs = std::set<std::pair<std::string, std::string>>;  // the lesser name first

/// One SRDF file beside the robot's URDF.
class Srdf {
 public:
  Srdf(const Source& source, const Document& urdf) : document_(source), urdf_(urdf) {
    check_expanded(document_.robot());
  }

  const Document& document() const { return document_; }

  /// As MoveIt has it: what is disabled by name is disabled, whatever is enabled.
  LinkPairs excluded() {
    LinkPairs pairs = named("disable_collisions");
    const LinkPairs enabled = named("enable_collisions");
    for (const XMLElement* e : document_.all("disable_default_collisions")) {
      const std::string link = given(document_, *e, "link");
      if (!is_known(*e, link)) continue;
      for (const std::string& other : urdf_.names("link")) {
        const std::pair<std::string, std::string> pair = std::minmax(link, other);
        if (other != link && enabled.count(pair) == 0) pairs.insert(pair);
      }
    }
    return pairs;
  }

  /// About links that the robot has not; "" where there is none.
  std::string warning() const {
    if (unknown_.empty()) return "";
    return first_unknown_ + "and below: links that the robot has not, " + list_names(unknown_) +
           " (not used); its links are " + list_names(urdf_.names("link"));
  }

 private:
  void check_expanded(const XMLElement& element) const {
    for (auto e = element.FirstChildElement(); e; e = e->NextSiblingElement()) {
      const std::string name = e->Name();
      if (name.rfind("xacro:", 0) == 0) {
        document_.fail(*e, {name, ""},
                       "is of a xacro file, which is to be expanded first: " +
                           std::string("xacro FILE.xacro > FILE.srdf"));
      }
      check_expanded(*e);
    }
  }

  bool is_known(const XMLElement& element, const std::string& link) {
    if (urdf_.find("link", link) != nullptr) return true;
    if (unknown_.empty()) {
      first_unknown_ = document_.at(element) + Owner{element.Name(), ""}.show() + " ";
    }
    if (std::find(unknown_.begin(), unknown_.end(), link) == unknown_.end()) {
      unknown_.push_back(link);
    }
    return false;
  }

  LinkPairs named(const char* element) {
    LinkPairs pairs;
    for (const XMLElement* e : document_.all(element)) {
      const std::string a = given(document_, *e, "link1"), b = given(document_, *e, "link2");
      const bool a_known = is_known(*e, a), b_known = is_known(*e, b);
      if (a_known && b_known) pairs.insert(std::minmax(a, b));
    }
    return pairs;
  }

  const Document document_;
  const Document& urdf_;
  std::string first_unknown_;
  std::vector<std::string> unknown_;
};

}  // namespace

void add_srdf(const std::string& path_or_text, const Document& urdf, bool strict,
              ModelBuilder& builder) {
  const Source source = read_source(path_or_text, "SRDF");
  if (!source.flaw.empty() && strict) throw ModelError(source.flaw);
  if (!source.flaw.empty()) builder.add_warning(source.flaw);
  Srdf srdf(source, urdf);
  for (const auto& [a, b] : srdf.excluded()) builder.add_body_exclusion(a, b);
  const std::string warning = srdf.warning();
  if (!warning.empty()) builder.add_warning(warning);
  add_group_states(srdf.document(), strict, builder);
}

}  // namespace saltus::reader
