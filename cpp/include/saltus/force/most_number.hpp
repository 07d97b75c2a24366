// How large the numbers may be that forces are made of.
#pragma once

namespace saltus {

/// Beyond it squares and products are no numbers any more. Infinite efforts and limits are none at
/// all, and no such number.
constexpr double most_number = 1e100;

}  // namespace saltus
