// Random contacts of random bodies, without a scene: W = R M^-1 R^T, and u in its range.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "variational/law/contact_problem.hpp"

namespace saltus {

struct RandomContacts {
  int contacts = 1, bodies = 1;
  double unlike = 0;    ///< masses are 10^-unlike to 10^unlike [kg]
  double friction = 0;  ///< at most
  bool jammed = false;  ///< every second contact faces the one before it
  bool open = false;    ///< some velocity opens all gaps
};

struct ContactsAtOnce {
  ContactBlocks W;
  std::vector<Vec3> u;
  MatX R, inverse;  ///< (3 m, n) rows, (n, n) M^-1
  VecX v;           ///< (n) u = R v
};

inline Vec3 random_unit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

inline void add_body_rows(const Mat3& axes, const Vec3& arm, double sign, Eigen::Ref<MatX> rows) {
  for (int k = 0; k < 3; ++k) {
    rows.row(k).head(3) += sign * axes.col(k).transpose();
    rows.row(k).tail(3) += sign * arm.cross(axes.col(k)).transpose();
  }
}

/// Bodies of six degrees each, about their middles; contacts between two, or one and the world.
inline ContactsAtOnce random_contacts(const RandomContacts& of, std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  ContactsAtOnce out;
  const int n = 6 * of.bodies, m = of.contacts;
  out.inverse.setZero(n, n);
  for (int b = 0; b < of.bodies; ++b) {
    const double mass = std::pow(10, of.unlike * (2 * unit(random) - 1));
    out.inverse.diagonal().segment(6 * b, 3).setConstant(1 / mass);
    for (int k = 3; k < 6; ++k)
      out.inverse(6 * b + k, 6 * b + k) = 1 / (mass * (0.1 + unit(random)));
  }
  out.R.setZero(3 * m, n);
  for (int i = 0; i < m; ++i) {
    if (of.jammed && i % 2 == 1) {  // from the other side, through the same point
      out.R.middleRows(3 * i, 3) = -out.R.middleRows(3 * (i - 1), 3);
      continue;
    }
    const Vec3 normal = random_unit(random);
    Mat3 axes;
    axes << normal, normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal());
    const int a = static_cast<int>(random() % static_cast<unsigned>(of.bodies));
    const int b =
        static_cast<int>(random() % static_cast<unsigned>(of.bodies + 1));  // or the world
    add_body_rows(axes, random_unit(random), 1, out.R.block(3 * i, 6 * a, 3, 6));
    if (b < of.bodies && b != a) {
      add_body_rows(axes, random_unit(random), -1, out.R.block(3 * i, 6 * b, 3, 6));
    }
  }
  out.W = contact_blocks(out.R * out.inverse * out.R.transpose());
  for (double& mu : out.W.friction) mu = of.friction * unit(random);
  out.v = VecX::NullaryExpr(n, [&] { return 2 * unit(random) - 1; });
  const VecX u = out.R * out.v;
  for (int i = 0; i < m; ++i) out.u.push_back(u.segment<3>(3 * i));
  return out;
}

/// The same W by the coordinates of the bodies: rates R, responses R M^-1.
inline void add_factors(ContactsAtOnce& c) {
  const auto bodies = c.v.size() / 6;
  const MatX responses = c.R * c.inverse;
  c.W.coordinates = static_cast<int>(c.v.size());
  for (Eigen::Index i = 0; i < c.R.rows() / 3; ++i) {
    ContactBlocks::Factors f;
    f.begin = c.W.rates.size();
    std::size_t count = 0;
    for (Eigen::Index b = 0; b < bodies; ++b) {
      if (c.R.block(3 * i, 6 * b, 3, 6).isZero(0)) continue;
      f.body.at(count++) = {static_cast<int>(6 * b), 6};
    }
    for (int row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < count; ++k) {
        for (int x = 0; x < 6; ++x) {
          c.W.rates.push_back(c.R(3 * i + row, f.body[k].first + x));
          c.W.responses.push_back(responses(3 * i + row, f.body[k].first + x));
        }
      }
    }
    c.W.factors.push_back(f);
  }
}

inline double kinetic_energy(const ContactsAtOnce& c, const VecX& v) {
  return 0.5 * v.dot(v.cwiseQuotient(c.inverse.diagonal()));
}

/// v after the impulses p.
inline VecX velocity_after(const ContactsAtOnce& c, const std::vector<Vec3>& p) {
  VecX force = VecX::Zero(c.v.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    force += c.R.middleRows(3 * static_cast<Eigen::Index>(i), 3).transpose() * p[i];
  }
  return c.v + c.inverse * force;
}

/// Contacts without friction: M, the normals N, and the velocity before.
struct NormalContacts {
  MatX M, N;
  VecX v;
  MatX G() const { return N * M.inverse() * N.transpose(); }
  double energy(const VecX& at) const { return 0.5 * at.dot(M * at); }
};

inline NormalContacts random_normals(const RandomContacts& of, std::mt19937& random) {
  const ContactsAtOnce c = random_contacts(of, random);
  NormalContacts out{c.inverse.diagonal().cwiseInverse().asDiagonal(), {}, c.v};
  out.N = c.R(Eigen::seqN(0, of.contacts, 3), Eigen::all);
  if (of.open) {
    const VecX w = VecX::NullaryExpr(c.v.size(), [&] { return random_unit(random)[0]; });
    for (int i = 0; i < of.contacts; ++i) {
      if (out.N.row(i).dot(w) < 0) out.N.row(i) *= -1;
    }
  }
  return out;
}

}  // namespace saltus
