// What a step tells: StepReport, by what has just been done.
#pragma once

#include "variational/arc/finish.hpp"
#include "variational/flight/flight.hpp"

namespace saltus {

/// Nothing told, but for fallbacks, which are the whole step's.
void clear(StepReport& report);

/// What held contacts closed in the arc just flown. Needs the contacts that it started with.
void tell_rows(const Node& node, const Rows& rows, StepReport& report);

/// What the law changed of the last strong impulse of an impact, by the arc just flown.
void tell_launch(const Launch& launch, const Flight& flight, StepReport& report);

void tell_settlings(const PairPool& pool, const Flight& flight, StepReport& report);

/// Of impulses that held contacts closed, each once.
void tell(const std::vector<ContactImpulse>& impulses, StepReport& report);

void tell_half_kick(const HalfKick& kick, StepReport& report);

}  // namespace saltus
