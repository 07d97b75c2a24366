// What holds contacts closed, told as StepReport::contacts; and what the arc after an impact has
// changed of it.
#pragma once

#include "variational/flight/flight.hpp"

namespace saltus {

/// Of the arc just flown. Needs the contacts that it started with.
void tell_rows(const Node& node, const Flight& flight, StepReport& report);

/// What the law changed of the last strong impulse of an impact, by the arc just flown.
void tell_launch(const Flight& flight, Node& node, StepReport& report);

/// How far the arc or the half kick just solved is from Coulomb's law.
void tell_residual(const Rows& rows, StepReport& report);

/// Of the closing half kick, flight.closings.
void tell_closing(const Flight& flight, StepReport& report);

}  // namespace saltus
