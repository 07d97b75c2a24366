// Finite reflection groups by their diagrams: J. Humphreys, Reflection Groups and Coxeter Groups,
// section 2.4. Nodes are mirrors, an edge with label m > 2 joins two that meet at pi/m.
#pragma once

#include <string>
#include <vector>

namespace saltus {

struct Edge {
  int a, b;
  int m;  ///< the angle is pi/m, m > 2
};

/// A connected diagram's group.
struct ReflectionGroup {
  std::string type;  ///< "A3", "I2(7)"; empty if the group is not finite
  long mirrors;      ///< number of its reflections, the length of its longest element
};

/// @param nodes their number; @param edges by numbers 0 .. nodes - 1; the diagram is connected
ReflectionGroup finite_group(int nodes, const std::vector<Edge>& edges);

}  // namespace saltus
