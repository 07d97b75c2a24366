#include "variational/uniqueness/coxeter.hpp"

#include <algorithm>
#include <array>

namespace saltus {
namespace {

const ReflectionGroup infinite{"", 0};

using Neighbours = std::vector<std::vector<int>>;

ReflectionGroup dihedral(int m) {
  switch (m) {
    case 3:
      return {"A2", 3};
    case 4:
      return {"B2", 4};
    default:
      return {"I2(" + std::to_string(m) + ")", m};
  }
}

/// Labels along a path, from one end to the other.
std::vector<int> labels(const Neighbours& next, const std::vector<Edge>& edges) {
  int at = 0, from = -1;
  while (next[at].size() != 1) ++at;
  std::vector<int> out;
  for (;;) {
    const auto on =
        std::find_if(next[at].begin(), next[at].end(), [&](int j) { return j != from; });
    if (on == next[at].end()) return out;
    const auto edge = std::find_if(edges.begin(), edges.end(), [&](const Edge& e) {
      return (e.a == at && e.b == *on) || (e.b == at && e.a == *on);
    });
    out.push_back(edge->m);
    from = at;
    at = *on;
  }
}

ReflectionGroup path(long n, std::vector<int> m) {
  const auto odd = std::find_if(m.begin(), m.end(), [](int label) { return label != 3; });
  if (odd == m.end()) return {"A" + std::to_string(n), n * (n + 1) / 2};
  if (std::count(m.begin(), m.end(), 3) != static_cast<long>(m.size()) - 1) return infinite;
  const bool at_end = odd == m.begin() || odd + 1 == m.end();
  if (*odd == 4 && at_end) return {"B" + std::to_string(n), n * n};
  if (*odd == 4 && n == 4) return {"F4", 24};
  if (*odd == 5 && at_end && n == 3) return {"H3", 15};
  if (*odd == 5 && at_end && n == 4) return {"H4", 60};
  return infinite;
}

/// Nodes on the way from a fork to the end of one of its arms; 0 if it forks again.
int arm(const Neighbours& next, int fork, int first) {
  int length = 1, from = fork, at = first;
  while (next[at].size() == 2) {
    const int on = next[at][0] == from ? next[at][1] : next[at][0];
    from = at;
    at = on;
    ++length;
  }
  return next[at].size() == 1 ? length : 0;
}

ReflectionGroup fork(long n, const Neighbours& next, int node) {
  if (next[node].size() != 3) return infinite;
  std::array<int, 3> arms{};
  for (std::size_t k = 0; k < 3; ++k) arms[k] = arm(next, node, next[node][k]);
  std::sort(arms.begin(), arms.end());
  if (arms[0] != 1) return infinite;
  if (arms[1] == 1) return {"D" + std::to_string(n), n * (n - 1)};
  if (arms[1] != 2 || arms[2] > 4) return infinite;
  constexpr std::array<long, 3> mirrors{36, 63, 120};
  return {"E" + std::to_string(n), mirrors[n - 6]};
}

}  // namespace

ReflectionGroup finite_group(int nodes, const std::vector<Edge>& edges) {
  if (nodes == 1) return {"A1", 1};
  if (nodes == 2) return dihedral(edges.front().m);
  if (static_cast<int>(edges.size()) != nodes - 1) return infinite;  // a cycle
  Neighbours next(static_cast<std::size_t>(nodes));
  for (const Edge& edge : edges) {
    next[edge.a].push_back(edge.b);
    next[edge.b].push_back(edge.a);
  }
  const auto forks = std::find_if(next.begin(), next.end(), [](auto& n) { return n.size() > 2; });
  if (forks == next.end()) return path(nodes, labels(next, edges));
  const bool plain = std::all_of(edges.begin(), edges.end(), [](auto& e) { return e.m == 3; });
  return plain ? fork(nodes, next, static_cast<int>(forks - next.begin())) : infinite;
}

}  // namespace saltus
