#include "variational/grip.hpp"

#include <cmath>

namespace saltus {
namespace {

/// One unknown of `polish`: an impulse at a contact along a direction, and the rate that it ends.
struct Unknown {
  int contact;
  int rate;
  Vec3 along;
};

struct Unknowns {
  std::array<Unknown, most_constraints> of;
  int count = 0;
  /// @return false where there is no room
  bool add(int contact, int rate, const Vec3& along) {
    if (count == most_constraints) return false;
    of[static_cast<std::size_t>(count++)] = {contact, rate, along};
    return true;
  }
};

bool list_unknowns(const ContactBlocks& W, const std::vector<Vec3>& u, const std::vector<Vec3>& p,
                   Unknowns& x) {
  IndependentRates rates(W);
  for (int i = 0; i < W.size(); ++i) {
    if (!(p[i][0] > 0)) continue;
    const Grip grip = grip_of(u[i], p[i], W.friction[i], W.rest[i]);
    const bool slides = grip.mode == Grip::Mode::slides;
    if (!x.add(i, 0, slides ? slide_direction(grip, W.friction[i]) : Vec3::UnitX())) return false;
    rates.take(i, 0);
  }
  const int normals = x.count;
  for (int k = 0; k < normals; ++k) {
    const int i = x.of[static_cast<std::size_t>(k)].contact;
    if (grip_of(u[i], p[i], W.friction[i], W.rest[i]).mode != Grip::Mode::sticks) continue;
    for (const int rate : {1, 2}) {
      if (rates.take(i, rate) && !x.add(i, rate, Vec3::Unit(rate))) return false;
    }
  }
  return true;
}

void set_system(const ContactBlocks& W, const Unknowns& x, const std::vector<Vec3>& u, SmallMat& A,
                SmallVec& b) {
  A.setZero();
  for (int j = 0; j < x.count; ++j) {
    const Unknown& by = x.of[static_cast<std::size_t>(j)];
    for (int i = 0; i < x.count; ++i) {
      const Unknown& at = x.of[static_cast<std::size_t>(i)];
      for (int k = W.start[by.contact]; k < W.start[by.contact + 1]; ++k) {
        if (W.contact[k] == at.contact) A(i, j) = W.block[k].row(at.rate).dot(by.along);
      }
    }
    b[j] = -u[by.contact][by.rate];
  }
}

}  // namespace

void reserve_blocks(ContactBlocks& W) {
  constexpr std::size_t reserved = most_constraints;
  W.start.reserve(reserved + 1);
  W.contact.reserve(reserved * reserved);
  W.block.reserve(reserved * reserved);
  W.own.reserve(reserved);
  for (auto* each : {&W.friction, &W.restitution, &W.rest}) each->reserve(reserved);
}

FrictionScratch::FrictionScratch(bool with_friction) : any(with_friction) {
  if (!any) return;
  reserve_blocks(W);
  for (auto* each : {&u, &p}) each->reserve(most_constraints);
  contact.reserve(most_constraints);
  impulses.reserve(1024);
}

double IndependentRates::entry(int contact, int rate, int k) const {
  const int other = contact_[static_cast<std::size_t>(k)];
  const int other_rate = rate_[static_cast<std::size_t>(k)];
  double sum = 0;
  for (int e = W_.start[contact]; e < W_.start[contact + 1]; ++e) {
    if (W_.contact[e] == other) sum += W_.block[e](other_rate, rate);
  }
  for (int e = W_.start[other]; e < W_.start[other + 1]; ++e) {
    if (W_.contact[e] == contact) sum += W_.block[e](rate, other_rate);
  }
  return sum / 2;
}

bool IndependentRates::take(int contact, int rate) {
  if (count_ == most_constraints) return false;
  if (count_ == 0) L_.setZero(most_constraints, most_constraints);
  const double own = W_.own[contact](rate, rate);
  double left = own;
  for (int k = 0; k < count_; ++k) {
    double x = entry(contact, rate, k);
    for (int j = 0; j < k; ++j) x -= L_(count_, j) * L_(k, j);
    L_(count_, k) = x /= L_(k, k);
    left -= x * x;
  }
  if (!(left > 1e-9 * own)) return false;
  L_(count_, count_) = std::sqrt(left);
  contact_[static_cast<std::size_t>(count_)] = contact;
  rate_[static_cast<std::size_t>(count_++)] = rate;
  return true;
}

Grip grip_of(const Vec3& u, const Vec3& p, double friction, double rest) {
  Grip grip;
  if (!(friction > 0 && p[0] > 0)) return grip;
  const double speed = u.tail<2>().norm(), limit = friction * p[0];
  grip.mode = Grip::Mode::sticks;
  // a contact inside of its cone does not slide: a rate there is what Gauss-Seidel has left over
  if (speed <= rest || p.tail<2>().norm() < limit * (1 - 1e-9)) return grip;
  grip.mode = Grip::Mode::slides;
  grip.slide = u.tail<2>() / speed;
  return grip;
}

void polish(const ContactBlocks& W, std::vector<Vec3>& u, std::vector<Vec3>& p) {
  Unknowns x;
  if (!list_unknowns(W, u, p, x) || x.count == 0) return;
  SmallMat A(x.count, x.count);
  SmallVec b(x.count);
  set_system(W, x, u, A, b);
  const SmallVec change = solve_small(A, b);
  if (!change.allFinite()) return;
  std::array<Vec3, most_constraints> dp;
  for (int i = 0; i < W.size() && i < most_constraints; ++i) dp[i].setZero();
  double size = 0;
  for (const Vec3& each : p) size = std::max(size, each[0]);
  for (int j = 0; j < x.count; ++j) {
    const Unknown& at = x.of[static_cast<std::size_t>(j)];
    if (at.contact >= most_constraints) return;
    dp[at.contact] += change[j] * at.along;
  }
  for (int i = 0; i < W.size() && i < most_constraints; ++i) {
    const Vec3 after = p[i] + dp[i];
    const double room = 1e-9 * size;  // what Gauss-Seidel has not settled is no reason
    if (after[0] < -room) return;
    if (after.tail<2>().norm() > W.friction[i] * (after[0] + room)) return;
  }
  for (int i = 0; i < W.size() && i < most_constraints; ++i) {
    if (dp[i].isZero(0)) continue;
    p[i] += dp[i];
    for (int k = W.start[i]; k < W.start[i + 1]; ++k) u[W.contact[k]] += W.block[k] * dp[i];
  }
}

}  // namespace saltus
