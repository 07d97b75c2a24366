#include "variational/arc/memory.hpp"

namespace saltus {

void remember(const Arc& arc, double t, const Rows& rows, Memory& memory) {
  memory.velocities.add(t + arc.tau / 2, arc.v);
  ++memory.arcs;
  for (const int i : rows.active) {
    const Row& row = rows.row[i];
    if (row.is_joint()) {
      const auto k = static_cast<std::size_t>(row.dry);
      if (memory.dry.size() <= k) memory.dry.resize(k + 1);
      memory.dry[k] = {row.p, arc.tau, memory.arcs, row.own};
      continue;
    }
    if (!(row.p[0] > 0)) continue;
    const auto slots = static_cast<std::size_t>(row.slot) + 1;
    if (memory.impulses.size() < slots) memory.impulses.resize(slots);
    memory.impulses[row.slot] = {row.p, arc.tau, memory.arcs, row.own};
  }
}

}  // namespace saltus
