#pragma once

#include "saltus/lagrangian/packed.hpp"

namespace saltus::packed {

/// Writes w.turn from w.s; joints that do not turn get 1, 0.
void set_turns(const PackedTree& t, Packed& w);

}  // namespace saltus::packed
