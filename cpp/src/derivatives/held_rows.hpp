// What the tape tells of a contact that an arc holds.
#pragma once

#include "derivatives/frame_derivative.hpp"
#include "derivatives/impulse_derivative.hpp"

namespace saltus {

inline int rates_of(const TapeRow& row) { return row.friction > 0 ? 3 : 1; }

/// Whose gap stays closed.
inline const Pair& watched(const TapeRow& row, const Pair& pair) {
  return row.is_frozen ? row.frozen : pair;
}

inline FrameChoice choice_of(const TapeRow& row, bool at_a) {
  FrameChoice out;
  out.axis = row.is_frozen ? -1 : row.axis;
  out.t_B = row.t_B;
  out.at_a = at_a;
  return out;
}

/// Where an arc starts, is evaluated, and ends.
struct Places {
  Kinematics start, middle, end;
};

inline Places places_of(const ModelData& model, const TapeArc& told, const ArcDerivative& arc) {
  const Kinematics kin(model.tree);
  Places out{kin, kin, kin};
  set_configuration(model.tree, told.q, out.start);
  set_configuration(model.tree, arc.s.q, out.middle);
  set_configuration(model.tree, told.q_end, out.end);
  return out;
}

}  // namespace saltus
