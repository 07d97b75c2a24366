#include "variational/grip.hpp"

#include <cmath>

namespace saltus {
namespace {

/// All normals, and the tangents that do not follow from others where they stick.
void list_unknowns(const ContactBlocks& W, const std::vector<Vec3>& u, const std::vector<Vec3>& p,
                   PolishScratch& x) {
  x.unknown.clear();
  x.rates.start();
  for (int i = 0; i < W.size(); ++i) {
    if (!(p[i][0] > 0)) continue;
    const Grip grip = grip_of(u[i], p[i], W.friction[i], W.rest[i]);
    const bool slides = grip.mode == Grip::Mode::slides;
    x.unknown.push_back({i, 0, slides ? slide_direction(grip, W.friction[i]) : Vec3::UnitX()});
    x.rates.take(W, i, 0);
  }
  const std::size_t normals = x.unknown.size();
  for (std::size_t k = 0; k < normals; ++k) {
    const int i = x.unknown[k].contact;
    if (grip_of(u[i], p[i], W.friction[i], W.rest[i]).mode != Grip::Mode::sticks) continue;
    for (const int rate : {1, 2}) {
      if (x.rates.take(W, i, rate)) x.unknown.push_back({i, rate, Vec3::Unit(rate)});
    }
  }
}

void set_system(const ContactBlocks& W, const std::vector<Vec3>& u, PolishScratch& x) {
  const int n = static_cast<int>(x.unknown.size());
  x.system.start(n);
  for (int j = 0; j < n; ++j) {
    const PolishUnknown& by = x.unknown[static_cast<std::size_t>(j)];
    for (int i = 0; i < n; ++i) {
      const PolishUnknown& at = x.unknown[static_cast<std::size_t>(i)];
      for (int k = W.start[by.contact]; k < W.start[by.contact + 1]; ++k) {
        if (W.contact[k] != at.contact) continue;
        x.system.A(i, j) = W.block[k].row(at.rate).dot(by.along);
        break;
      }
    }
    x.system.b(j) = -u[by.contact][by.rate];
  }
}

/// The block of W that contact `at` feels of `by`, nullptr where none.
const Mat3* find_block(const ContactBlocks& W, int at, int by) {
  for (int e = W.start[by]; e < W.start[by + 1]; ++e) {
    if (W.contact[e] == at) return &W.block[e];
  }
  return nullptr;
}

}  // namespace

void PolishScratch::reserve(std::size_t contacts) {
  const std::size_t rates_of_all = 3 * contacts;
  unknown.reserve(rates_of_all);
  change.reserve(contacts);
  for (auto* each : {&rates.contact, &rates.rate}) each->reserve(rates_of_all);
  rates.L.reserve(rates_of_all * (rates_of_all + 1) / 2);
  system.reserve(static_cast<int>(rates_of_all));
}

FrictionScratch::FrictionScratch(bool with_friction) : any(with_friction) {
  if (!any) return;
  constexpr std::size_t a_few_boxes = 16;
  reserve(a_few_boxes);
  impulses.reserve(1024);
}

void FrictionScratch::reserve(std::size_t contacts) {
  if (contacts <= contact.capacity()) return;
  W.start.reserve(contacts + 1);
  W.contact.reserve(contacts * contacts);
  W.block.reserve(contacts * contacts);
  W.own.reserve(contacts);
  for (auto* each : {&W.friction, &W.restitution, &W.rest}) each->reserve(contacts);
  for (auto* each : {&u, &p}) each->reserve(contacts);
  contact.reserve(contacts);
  pile.reserve(contacts);
  polish.reserve(contacts);
}

bool IndependentRates::take(const ContactBlocks& W, int at, int of) {
  const std::size_t count = contact.size(), first = L.size();  // of row `count`
  const double own = W.own[at](of, of);
  double left = own;
  for (std::size_t k = 0; k < count; ++k) {
    const Mat3* block = find_block(W, contact[k], at);
    double x = block ? (*block)(rate[k], of) : 0;
    const std::size_t other = k * (k + 1) / 2;
    for (std::size_t j = 0; j < k; ++j) x -= L[first + j] * L[other + j];
    x /= L[other + k];
    L.push_back(x);
    left -= x * x;
  }
  if (!(left > 1e-9 * own)) {
    L.resize(first);
    return false;
  }
  L.push_back(std::sqrt(left));
  contact.push_back(at);
  rate.push_back(of);
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

void polish(const ContactBlocks& W, PolishScratch& x, std::vector<Vec3>& u, std::vector<Vec3>& p) {
  list_unknowns(W, u, p, x);
  if (x.unknown.empty()) return;
  set_system(W, u, x);
  x.system.solve();
  x.change.assign(p.size(), Vec3::Zero());
  double size = 0;
  for (const Vec3& each : p) size = std::max(size, each[0]);
  for (std::size_t j = 0; j < x.unknown.size(); ++j) {
    const double change = x.system.b(static_cast<int>(j));
    if (!std::isfinite(change)) return;
    x.change[x.unknown[j].contact] += change * x.unknown[j].along;
  }
  for (int i = 0; i < W.size(); ++i) {
    const Vec3 after = p[i] + x.change[i];
    const double room = 1e-9 * size;  // what is not settled to the last digit is no reason
    if (after[0] < -room) return;
    if (after.tail<2>().norm() > W.friction[i] * (after[0] + room)) return;
  }
  for (int i = 0; i < W.size(); ++i) {
    if (x.change[i].isZero(0)) continue;
    p[i] += x.change[i];
    for (int k = W.start[i]; k < W.start[i + 1]; ++k) u[W.contact[k]] += W.block[k] * x.change[i];
  }
}

}  // namespace saltus
