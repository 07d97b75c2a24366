#include <map>

#include "saltus/model/model.hpp"
#include "urdf/checks.hpp"

namespace saltus::reader {
namespace {

struct Edge {
  std::string parent;
  const XMLElement* joint;
};
using ParentOf = std::map<std::string, Edge>;  // child link -> parent link and the joint between

std::string end_of(const Document& document, const XMLElement& joint, const char* role) {
  const XMLElement& end = *joint.FirstChildElement(role);
  const std::string link = attribute(end, "link");
  if (document.find("link", link) == nullptr) {
    document.fail(end, {"joint", attribute(joint, "name")},
                  "names " + std::string(role) + " link " + in_quotes(link) +
                      ", which does not exist; links are " + list_names(document.names("link")));
  }
  return link;
}

ParentOf parents(const Document& document) {
  ParentOf parent_of;
  for (const XMLElement* joint : document.all("joint")) {
    const std::string parent = end_of(document, *joint, "parent");
    const std::string child = end_of(document, *joint, "child");
    const auto [first, is_new] = parent_of.emplace(child, Edge{parent, joint});
    if (is_new) continue;
    const XMLElement& other = *first->second.joint;
    document.fail(*joint, {"joint", attribute(*joint, "name")},
                  "gives link " + in_quotes(child) + " a second parent, " + in_quotes(parent) +
                      "; joint " + in_quotes(attribute(other, "name")) + " in line " +
                      std::to_string(other.GetLineNum()) + " gives it " +
                      in_quotes(first->second.parent) + " (a URDF is a tree)");
  }
  return parent_of;
}

/// "a -> b -> c -> a", parents first, from any link on the cycle.
std::string show_cycle(const ParentOf& parent_of, const std::string& start) {
  std::string text = start;
  int shown = 1;
  for (std::string at = parent_of.at(start).parent;; at = parent_of.at(at).parent) {
    const bool closed = at == start;
    if (++shown <= 20 || closed) {
      text = at + " -> " + text;
    } else if (shown == 21) {
      text = "... -> " + text;
    }
    if (closed) return text;
  }
}

/// Walks up from every link; a walk that meets itself has found a cycle.
void check_no_cycle(const Document& document, const ParentOf& parent_of) {
  std::map<std::string, std::string> walk;  // link -> the link whose walk came here first
  for (const XMLElement* link : document.all("link")) {
    const std::string start = attribute(*link, "name");
    std::string at = start;
    while (walk.emplace(at, start).second) {
      const auto edge = parent_of.find(at);
      if (edge == parent_of.end()) break;
      at = edge->second.parent;
      const auto seen = walk.find(at);
      if (seen == walk.end() || seen->second != start) continue;
      const XMLElement& joint = *parent_of.at(at).joint;
      document.fail(joint, {"joint", attribute(joint, "name")},
                    "closes a cycle of links: " + show_cycle(parent_of, at));
    }
  }
}

}  // namespace

std::string check_tree(const Document& document) {
  const std::vector<std::string> links = document.names("link");
  if (links.empty()) throw ModelError(document.at(document.robot()) + "the robot has no <link>");
  const ParentOf parent_of = parents(document);
  check_no_cycle(document, parent_of);
  std::vector<std::string> roots;
  for (const std::string& link : links) {
    if (parent_of.count(link) == 0) roots.push_back(link);
  }
  // without a cycle there is a root
  if (roots.size() > 1) {
    document.fail(*document.find("link", roots[1]), {"link", roots[1]},
                  "has no joint above it: a robot has one root, and here are " +
                      std::to_string(roots.size()) + ": " + list_names(roots));
  }
  return roots.front();
}

}  // namespace saltus::reader
