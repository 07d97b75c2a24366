// What holds contacts closed, told as StepReport::contacts; and what the arc after an impact has
// changed of it.
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

/// Of the arc just flown. Needs the contacts that it started with.
void tell_holds(const Node& node, Flight& flight, StepReport& report);

/// What the law changed of the last strong impulse of an impact, by the arc just flown.
void tell_launch(const Flight& flight, Node& node, StepReport& report);

/// Of held contacts at nodes, node.closing, which is then empty.
void tell_closing(Node& node, StepReport& report);

}  // namespace saltus
