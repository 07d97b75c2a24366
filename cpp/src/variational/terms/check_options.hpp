// The ranges of StepOptions.
#pragma once

#include "saltus/variational/options.hpp"

namespace saltus {

/// @throws ModelError where an option is out of its range, or a law without its function.
void check_options(const StepOptions& options);

}  // namespace saltus
