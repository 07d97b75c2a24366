// Many directions of a step at once, as columns: arcs by their matrices, impacts one by one.
#pragma once

#include "derivatives/dense_arc.hpp"
#include "derivatives/program.hpp"

namespace saltus {

/// By what the columns are: one a number of it.
enum class Input { state, control, qfrc, restitution, friction, forces, torques };

/// Z <- (2 n_v, columns) what the state at the step's end changes by; of the state q, then p.
void push_columns(const ModelData& model, const Tape& tape, Input input, StepProgram& program,
                  DenseScratch& scratch, MatX& Z);

}  // namespace saltus
