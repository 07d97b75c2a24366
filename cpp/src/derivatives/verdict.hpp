// What a derivative through impacts is worth (theory, D4, D5).
#pragma once

#include "derivatives/program.hpp"

namespace saltus {

/// An order of the impulses of one impact, and where it leads.
struct ImpactOrderFound {
  std::vector<int> contacts;
  VecX p;
};

/// All orders of an impact's impulses, depth first: a contact that does not approach cannot be
/// next. The step's own comes first.
/// @param most orders, and impulses in one; what is beyond is left out
std::vector<ImpactOrderFound> find_orders(const ModelData& model, const TapeImpact& told,
                                          ImpactPieces& impact, int most);

/// True where two outcomes are one but for rounding.
bool is_same_outcome(const VecX& p, const VecX& other);

/// Pairs that touch and whose rate is rest before the impact or after it.
void list_weak(const TapeImpact& told, ImpactPieces& impact, std::vector<int>& weak);

/// Writes pairs, depth and weak; spread is left alone.
ImpactDerivative describe(const ModelData& model, const TapeImpact& told, ImpactPieces& impact);

/// The worst of both.
Smoothness worse(Smoothness a, Smoothness b);

}  // namespace saltus
