// The parsed XML and its index: which element has which name, and where it stands.
#pragma once

#include <tinyxml2.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "saltus/error.hpp"
#include "urdf/source.hpp"

namespace saltus::reader {

using tinyxml2::XMLElement;

/// The named part of the file that an error is about.
struct Owner {
  std::string element;  ///< "link", "joint", "half_space", ...; "robot" for the whole
  std::string name;

  std::string show() const;  ///< `joint "elbow"`; `<robot>`, `capsule` where there is no name
};

std::string attribute(const XMLElement& element, const char* name);  ///< "" where there is none
std::string in_quotes(const std::string& name);

/// "${mass}", "$(find arm)": what xacro replaces, where it was not run.
bool has_xacro(const std::string& text);
/// `has <mass value="${m}">: ` goes on with this.
extern const char* const xacro_expression;

class Document {
 public:
  /// @throws ModelError if the text is no XML or has not one `<robot>`.
  explicit Document(const Source& source);

  const XMLElement& robot() const { return *robot_; }
  const std::string& label() const { return label_; }

  /// Elements of this name below `<robot>`, in the file's order.
  std::vector<const XMLElement*> all(const char* element) const;
  std::vector<std::string> names(const char* element) const;
  /// The element below `<robot>` (or `<saltus>`) with this name, or null.
  const XMLElement* find(const std::string& element, const std::string& name) const;

  /// "arm.urdf:41: "
  std::string at(const XMLElement& element) const;
  /// @throws ModelError "arm.urdf:41: joint "wrist" <what>".
  [[noreturn]] void fail(const XMLElement& at, const Owner& owner, const std::string& what) const;
  /// The error of a floor below, with the place of its culprit.
  ModelError located(const ModelError& error) const;

 private:
  void find_robot();
  void index(const XMLElement& parent);

  std::string label_;
  tinyxml2::XMLDocument xml_;
  const XMLElement* robot_ = nullptr;
  std::map<std::pair<std::string, std::string>, const XMLElement*> index_;
};

}  // namespace saltus::reader
