#include "saltus/model/dynamics.hpp"

#include <algorithm>

namespace saltus {
namespace {

/// An argument with a row for each configuration, or one for all.
struct Argument {
  const RowsRef& x;
  int width;
  const char* name;
  const char* unit;  ///< what it has `width` of
};

/// How many rows the result has.
Eigen::Index count_rows(const std::vector<Argument>& arguments) {
  Eigen::Index rows = 1;
  const Argument* longest = nullptr;
  for (const Argument& each : arguments) {
    if (each.x.cols() != each.width) {
      throw ModelError("rows of " + std::string(each.name) + " have " +
                       counted(each.x.cols(), "entry") + "; the model has " +
                       std::to_string(each.width) + " " + each.unit);
    }
    if (each.x.rows() == 1) continue;
    if (longest && each.x.rows() != rows) {
      throw ModelError(std::string(longest->name) + " has " + counted(rows, "row") + " and " +
                       each.name + " has " + std::to_string(each.x.rows()) +
                       "; they have equally many, or one of them has 1");
    }
    rows = each.x.rows();
    longest = &each;
  }
  for (const Argument& each : arguments) {
    for (Eigen::Index row = 0; row < each.x.rows(); ++row) {
      if (each.x.row(row).allFinite()) continue;
      throw ModelError("row " + std::to_string(row) + " of " + each.name + " is not finite");
    }
  }
  return rows;
}

VecX row_of(const RowsRef& x, Eigen::Index row) {
  return x.row(x.rows() == 1 ? 0 : row).transpose();
}

/// Calls f(row, frames) with the frames at every row of q; those of one row are placed once.
template <class F>
void for_each_row(const Model& model, const RowsRef& q, Eigen::Index rows, const F& f) {
  Frames frames(model);
  for (Eigen::Index row = 0; row < rows; ++row) {
    if (row == 0 || q.rows() > 1) {
      frames.set(row_of(q, row), "row " + std::to_string(row) + " of q");
    }
    try {
      f(row, frames);
    } catch (const ModelError& error) {  // of its loops
      if (rows == 1) throw;
      throw ModelError("row " + std::to_string(row) + ": " + error.what(), error.element,
                       error.name);
    }
  }
}

Argument coordinates(const Model& model, const RowsRef& q) {
  return {q, model.n_q(), "q", "coordinates"};
}
Argument velocities(const Model& model, const RowsRef& x, const char* name) {
  return {x, model.n_v(), name, "velocities"};
}

/// Poses of `count` bodies, (rows, 16 count).
MatX poses_by_row(const Model& model, const RowsRef& q, std::size_t count,
                  MatX (Frames::*poses)() const) {
  const Eigen::Index rows = count_rows({coordinates(model, q)});
  MatX out(rows, static_cast<Eigen::Index>(16 * count));
  for_each_row(model, q, rows, [&](Eigen::Index row, const Frames& frames) {
    out.row(row) = (frames.*poses)().reshaped<Eigen::RowMajor>().transpose();
  });
  return out;
}

}  // namespace

MatX all_poses(const Model& model, const RowsRef& q) {
  return poses_by_row(model, q, model->links.size(), &Frames::all_poses);
}

MatX all_shape_poses(const Model& model, const RowsRef& q) {
  return poses_by_row(model, q, model->shapes.size(), &Frames::all_shape_poses);
}

MatX jacobians(const Model& model, const RowsRef& q, int link, const std::optional<Vec3>& p_L) {
  const Eigen::Index rows = count_rows({coordinates(model, q)}), n = model.n_v();
  const Eigen::Index height = p_L ? 3 : 6;
  AttachedFrame frame = link_frame(model, link);
  if (p_L) frame.X_JF.p = frame.X_JF * *p_L;
  MatX out(rows, height * n), J;
  for_each_row(model, q, rows, [&](Eigen::Index row, const Frames& frames) {
    frames.jacobian(frame, J);
    Eigen::Map<MatX>(out.row(row).data(), height, n) = J.bottomRows(height);
  });
  return out;
}

MatX centres_of_mass(const Model& model, const RowsRef& q) {
  const Eigen::Index rows = count_rows({coordinates(model, q)});
  MatX out(rows, 3);
  for_each_row(model, q, rows, [&](Eigen::Index row, Frames& frames) {
    out.row(row) = frames.centre_of_mass().transpose();
  });
  return out;
}

MatX momenta(const Model& model, const RowsRef& q, const RowsRef& v, const RowsRef& p_W) {
  const Eigen::Index rows = count_rows(
      {coordinates(model, q), velocities(model, v, "v"), {p_W, 3, "about", "axes in the world"}});
  MatX out(rows, 6);
  for_each_row(model, q, rows, [&](Eigen::Index row, Frames& frames) {
    Vec6 sum = frames.momentum(row_of(v, row));
    sum.head<3>() -= Vec3(row_of(p_W, row)).cross(Vec3(linear(sum)));
    out.row(row) = sum.transpose();
  });
  return out;
}

MatX gravity_forces(const Model& model, const RowsRef& q) {
  const Eigen::Index rows = count_rows({coordinates(model, q)});
  MatX out(rows, model.n_v());
  VecX forces;
  for_each_row(model, q, rows, [&](Eigen::Index row, Frames& frames) {
    frames.gravity_forces(forces);
    out.row(row) = forces.transpose();
  });
  return out;
}

MatX inverse_dynamics(const Model& model, const RowsRef& q, const RowsRef& v, const RowsRef& a,
                      double t) {
  const Eigen::Index rows =
      count_rows({coordinates(model, q), velocities(model, v, "v"), velocities(model, a, "a")});
  MatX out(rows, model.n_v());
  VecX forces;
  for_each_row(model, q, rows, [&](Eigen::Index row, Frames& frames) {
    frames.inverse_dynamics(row_of(v, row), row_of(a, row), forces, t);
    out.row(row) = forces.transpose();
  });
  return out;
}

MatX accelerations(const Model& model, const RowsRef& q, const RowsRef& v, const RowsRef& forces,
                   double t) {
  const Eigen::Index rows = count_rows(
      {coordinates(model, q), velocities(model, v, "v"), velocities(model, forces, "forces")});
  MatX out(rows, model.n_v());
  VecX a;
  for_each_row(model, q, rows, [&](Eigen::Index row, Frames& frames) {
    frames.accelerations(row_of(v, row), row_of(forces, row), a, t);
    out.row(row) = a.transpose();
  });
  return out;
}

}  // namespace saltus
