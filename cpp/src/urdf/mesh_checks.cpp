#include "urdf/mesh_checks.hpp"

#include <tinyxml2.h>

#include <fstream>
#include <map>

#include "saltus/error.hpp"

namespace saltus::reader {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

constexpr double most_nodes = 1e5;

std::string read(std::ifstream& file, std::uintmax_t from, std::uintmax_t count) {
  std::string text(count, '\0');
  file.seekg(static_cast<std::streamoff>(from));
  file.read(text.data(), static_cast<std::streamsize>(count));
  return text;
}

bool is(const XMLElement& element, const char* name) { return std::string(element.Name()) == name; }

/// How many nodes a COLLADA file has once all their instances are made.
class DaeNodes {
 public:
  explicit DaeNodes(const XMLElement& root) : root_(root) { index(root); }

  void check() {
    if (below(root_) <= most_nodes) return;
    fail_mesh("has more than 100000 nodes, those that are instances counted each time");
  }

 private:
  void index(const XMLElement& element) {
    if (is(element, "node") && element.Attribute("id") != nullptr) {
      nodes_.emplace(element.Attribute("id"), &element);
    }
    for (auto e = element.FirstChildElement(); e; e = e->NextSiblingElement()) index(*e);
  }

  /// Each node with an id is walked once: its number is below 0 while it is.
  double of_node(const std::string& id, const XMLElement& node) {
    const auto [at, is_new] = size_.emplace(id, -1);
    if (!is_new && at->second < 0) fail_mesh("has a node \"" + id + "\" that contains itself");
    if (is_new) at->second = 1 + below(node);
    return at->second;
  }

  double below(const XMLElement& element) {
    if (++depth_ > TINYXML2_MAX_ELEMENT_DEPTH) {
      fail_mesh("has nodes nested more than " + std::to_string(TINYXML2_MAX_ELEMENT_DEPTH) +
                " deep");
    }
    double sum = 0;
    for (auto e = element.FirstChildElement(); e && sum <= most_nodes;
         e = e->NextSiblingElement()) {
      const char* url = is(*e, "instance_node") ? e->Attribute("url") : nullptr;
      const char* id = is(*e, "node") ? e->Attribute("id") : url;
      const auto found = nodes_.find(id == nullptr ? "" : id + (url != nullptr && *url == '#'));
      const bool is_other = found == nodes_.end() || (url == nullptr && found->second != e);
      sum += is_other ? is(*e, "node") + below(*e) : of_node(found->first, *found->second);
    }
    --depth_;
    return sum;
  }

  const XMLElement& root_;
  std::map<std::string, const XMLElement*> nodes_;  // by id, the first of each
  std::map<std::string, double> size_;
  int depth_ = 0;
};

}  // namespace

void fail_mesh(const std::string& what) { throw ModelError(what); }

void check_is_here(const fs::path& path) {
  const std::string pointer = "version https://git-lfs";
  std::ifstream file(path, std::ios::binary);
  if (read(file, 0, pointer.size()) == pointer) fail_mesh("is a pointer of Git LFS, not the mesh");
}

void check_stl(const fs::path& path, std::uintmax_t size) {
  constexpr std::uintmax_t header = 84, facet = 50;
  std::ifstream file(path, std::ios::binary);
  const std::string head = read(file, 0, std::min(size, header));
  std::uintmax_t facets = 0;
  for (std::size_t i = 0; i < 4 && 80 + i < head.size(); ++i) {
    facets += std::uintmax_t{static_cast<unsigned char>(head[80 + i])} << (8 * i);
  }
  const std::uintmax_t needed = header + facet * facets;
  if (size >= header && size == needed) return;
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && head.compare(first, 5, "solid") == 0) {
    const std::uintmax_t tail = std::min<std::uintmax_t>(size, 4096);
    if (read(file, size - tail, tail).find("endsolid") == std::string::npos) {
      fail_mesh("is cut short: an ASCII STL ends with \"endsolid\"");
    }
  } else if (size < needed || size < header) {
    fail_mesh("is cut short: it has " + std::to_string(size) + " bytes, and a binary STL of " +
              std::to_string(facets) + " facets has " + std::to_string(needed));
  }
}

void check_dae(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  tinyxml2::XMLDocument xml;
  if (xml.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    if (xml.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) {
      fail_mesh("has elements nested more than " + std::to_string(TINYXML2_MAX_ELEMENT_DEPTH) +
                " deep");
    }
    fail_mesh("cannot be read: it is no XML (line " + std::to_string(xml.ErrorLineNum()) + ")");
  }
  if (xml.RootElement() != nullptr) DaeNodes(*xml.RootElement()).check();
}

}  // namespace saltus::reader
