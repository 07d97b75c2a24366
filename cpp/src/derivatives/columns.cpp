#include "derivatives/columns.hpp"

#include "derivatives/applied_derivative.hpp"

namespace saltus {
namespace {

using Kind = StepProgram::Kind;

/// Of fewer coordinates than this a matrix saves a microsecond at most over columns one by one.
constexpr Eigen::Index few = 4;

Eigen::Index count_of(const ModelData& model, const Tape& tape, Input input,
                      const StepProgram& program) {
  switch (input) {
    case Input::state:
      return 2 * model.tree.n_v;
    case Input::control:
      return model.forces.n_u();
    case Input::qfrc:
      return model.tree.n_v;
    case Input::restitution:
      return program.n_impacts;
    case Input::friction:
      return static_cast<Eigen::Index>(program.friction.pairs.size());
    case Input::forces:
    case Input::torques:
      break;
  }
  return static_cast<Eigen::Index>(3 * tape.input.wrenches.size());
}

/// Column c of the input, but for the state, which is in Z.
StepDirection unit_of(Input input, Eigen::Index columns, Eigen::Index c) {
  StepDirection by;
  const VecX unit = VecX::Unit(columns, c);
  if (input == Input::control) by.control = unit;
  if (input == Input::qfrc) by.qfrc = unit;
  if (input == Input::restitution) by.restitution = unit;
  if (input == Input::friction) by.friction = unit;
  if (input == Input::forces || input == Input::torques) {
    MatX& to = input == Input::forces ? by.forces : by.torques;
    to.setZero(columns / 3, 3);
    to(c / 3, c % 3) = 1;
  }
  return by;
}

/// Forces (n_v, columns) on an arc; without columns: none.
MatX forces_of(const ModelData& model, const Tape& tape, Input input, const FlownArc& arc) {
  const Eigen::Index n = model.tree.n_v;
  if (input == Input::control) return arc.arc.Q_u;
  if (input == Input::qfrc) return MatX::Identity(n, n);
  const bool is_force = input == Input::forces;
  if ((!is_force && input != Input::torques) || tape.input.wrenches.empty()) return {};
  MatX out(n, 3 * tape.input.wrenches.size());
  VecX column;
  for (Eigen::Index c = 0; c < out.cols(); ++c) {
    const Vec3 unit = Vec3::Unit(c % 3), none = Vec3::Zero();
    column.setZero(n);
    add_push(model, arc.arc.s.w, tape.input.wrenches[static_cast<std::size_t>(c / 3)],
             is_force ? unit : none, is_force ? none : unit, column);
    out.col(c) = column;
  }
  return out;
}

/// Columns as they go through the pieces; `energy` by what a law that matches one has found.
struct Pushed {
  MatX& Z;
  VecX left, energy;
};

void push_each(const ModelData& model, const Tape& tape, Input input,
               const StepProgram::Piece& piece, StepProgram& program, Pushed& all) {
  const Eigen::Index n = model.tree.n_v, columns = all.Z.cols();
  Tangent z;
  for (Eigen::Index c = 0; c < columns; ++c) {
    z.q = all.Z.col(c).head(n);
    z.p = all.Z.col(c).tail(n);
    z.energy = all.energy[c];
    push_piece(model, tape, unit_of(input, columns, c), Order::own, piece, program, z, all.left[c]);
    all.Z.col(c) << z.q, z.p;
    all.energy[c] = z.energy;
  }
}

}  // namespace

void push_columns(const ModelData& model, const Tape& tape, Input input, StepProgram& program,
                  DenseScratch& scratch, MatX& Z) {
  const Eigen::Index n = model.tree.n_v, columns = count_of(model, tape, input, program);
  bool is_unit = input == Input::state;
  if (is_unit) {
    Z.setIdentity(2 * n, columns);
  } else {
    Z.setZero(2 * n, columns);
  }
  Pushed all{Z, VecX::Zero(columns), VecX::Zero(columns)};
  if (program.start.q.size() > 0) {
    all.energy =
        Z.topRows(n).transpose() * program.start.q + Z.bottomRows(n).transpose() * program.start.p;
  }
  for (const StepProgram::Piece& piece : program.pieces) {
    const bool is_arc = piece.kind != Kind::impact && piece.kind != Kind::pass;
    FlownArc* arc = is_arc ? program.arcs[static_cast<std::size_t>(piece.index)].get() : nullptr;
    if (n >= few && is_arc && is_plain(*arc) && set_dense(model, *arc, scratch)) {
      const VecX dtau = piece.kind == Kind::rest ? all.left : VecX::Zero(columns);
      push_dense(model, *arc, forces_of(model, tape, input, *arc), dtau, is_unit, Z);
      if (piece.kind == Kind::rest) all.left.setZero();
    } else {
      push_each(model, tape, input, piece, program, all);
    }
    is_unit = false;
  }
  if (!program.has_rest) return;
  Z.topRows(n) += program.motion.q * all.left.transpose();
  Z.bottomRows(n) += program.motion.p * all.left.transpose();
}

}  // namespace saltus
