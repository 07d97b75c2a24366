// What holds contacts closed, told as StepReport::contacts.
#pragma once

#include "variational/flight.hpp"

namespace saltus {

/// Of the arc just flown. Needs the contacts that it started with.
void tell_holds(const Node& node, Flight& flight, StepReport& report);

/// Of held contacts at nodes, node.closing, which is then empty.
void tell_closing(Node& node, StepReport& report);

}  // namespace saltus
