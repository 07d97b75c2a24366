#include "urdf/document.hpp"

#include <algorithm>

namespace saltus::reader {
namespace {

/// What tinyxml2's error means for whoever wrote the file.
std::string explain(const tinyxml2::XMLDocument& xml) {
  switch (xml.ErrorID()) {
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "a tag is not closed by '>'";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is given twice, lacks its quotes, or its value never ends";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "text outside of all elements";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment never ends";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element is not closed, or closed by the tag of another";
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "it has no element";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested more than " + std::to_string(TINYXML2_MAX_ELEMENT_DEPTH) +
             " deep, the most that is read";
    case tinyxml2::XML_ERROR_PARSING:
      return "it ends before all elements are closed";
    default:
      return "it cannot be parsed";
  }
}

/// tinyxml2 appends the culprit, "...: XMLElement name=link".
std::string culprit(const tinyxml2::XMLDocument& xml) {
  const std::string text = xml.ErrorStr() == nullptr ? "" : xml.ErrorStr();
  const std::size_t found = text.rfind("name=");
  return found == std::string::npos ? "" : " (<" + text.substr(found + 5) + ">)";
}

/// The last line where the text ends too early; tinyxml2 tells the first then, or none.
std::ptrdiff_t error_line(const tinyxml2::XMLDocument& xml, const std::string& text) {
  const bool ended = xml.ErrorID() == tinyxml2::XML_ERROR_PARSING;
  if (!ended && xml.ErrorLineNum() > 0) return xml.ErrorLineNum();
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(last), '\n');
}

}  // namespace

std::string Owner::show() const {
  if (name.empty()) return "<" + element + ">";
  return element + " " + in_quotes(name);
}

std::string attribute(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

std::string in_quotes(const std::string& name) { return "\"" + name + "\""; }

bool has_xacro(const std::string& text) {
  return text.find("${") != std::string::npos || text.find("$(") != std::string::npos;
}

const char* const xacro_expression =
    "an expression of xacro that was not expanded; xacro FILE.xacro > FILE.urdf does it";

Document::Document(const Source& source) : label_(source.label) {
  if (xml_.Parse(source.text.data(), source.text.size()) != tinyxml2::XML_SUCCESS) {
    throw ModelError(label_ + ":" + std::to_string(error_line(xml_, source.text)) +
                     ": not XML: " + explain(xml_) + culprit(xml_));
  }
  find_robot();
  index(*robot_);
  for (const XMLElement* block : all("saltus")) index(*block);
}

void Document::find_robot() {
  const XMLElement* root = xml_.RootElement();
  if (root == nullptr) throw ModelError(label_ + ":1: no <robot> element; the XML has no element");
  robot_ = xml_.FirstChildElement("robot");
  if (robot_ == nullptr) {
    throw ModelError(at(*root) + "no <robot> element: the root element is <" + root->Name() +
                     ">; URDF and SRDF begin with <robot name=\"...\">");
  }
  if (const XMLElement* second = robot_->NextSiblingElement("robot")) {
    throw ModelError(at(*second) + "a second <robot>; the first is in line " +
                     std::to_string(robot_->GetLineNum()));
  }
}

void Document::index(const XMLElement& parent) {
  for (const XMLElement* e = parent.FirstChildElement(); e; e = e->NextSiblingElement()) {
    index_.emplace(std::pair{std::string(e->Name()), attribute(*e, "name")}, e);
  }
}

std::vector<const XMLElement*> Document::all(const char* element) const {
  std::vector<const XMLElement*> found;
  for (auto e = robot_->FirstChildElement(element); e; e = e->NextSiblingElement(element)) {
    found.push_back(e);
  }
  return found;
}

std::vector<std::string> Document::names(const char* element) const {
  std::vector<std::string> found;
  for (const XMLElement* e : all(element)) found.push_back(attribute(*e, "name"));
  return found;
}

const XMLElement* Document::find(const std::string& element, const std::string& name) const {
  const auto found = index_.find({element, name});
  return found == index_.end() ? nullptr : found->second;
}

std::string Document::at(const XMLElement& element) const {
  return label_ + ":" + std::to_string(element.GetLineNum()) + ": ";
}

void Document::fail(const XMLElement& where, const Owner& owner, const std::string& what) const {
  throw ModelError(at(where) + owner.show() + " " + what, owner.element, owner.name);
}

ModelError Document::located(const ModelError& error) const {
  if (std::string(error.what()).rfind(label_ + ":", 0) == 0) return error;  // a reader's own
  const XMLElement* culprit = find(error.element, error.name);
  const std::string place = culprit == nullptr ? label_ + ": " : at(*culprit);
  return ModelError(place + error.what(), error.element, error.name);
}

}  // namespace saltus::reader
