// The second partials alone, where generators are there already.
#pragma once

#include "saltus/lagrangian/partials.hpp"

namespace saltus {

/// L_qq, L_vq and L_vv at what second_pass left in w; `rows` are scratch. Columns of forces in
/// Packed::coupled are in L_qq as well, slopes of forces on one coordinate are not.
SALTUS_EXPORT void second_partials(const Tree& tree, const PackedTree& packed, const Packed& w,
                                   SecondPartials& rows, LagrangianPartials& L);

}  // namespace saltus
