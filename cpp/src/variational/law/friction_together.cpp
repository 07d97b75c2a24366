#include "variational/law/friction_together.hpp"

#include <algorithm>
#include <cmath>

#include "variational/law/contact_parts.hpp"
#include "variational/law/coulomb.hpp"

namespace saltus {
namespace {

std::vector<Part> approaching_parts(const ContactBlocks& W, const std::vector<Vec3>& u) {
  std::vector<char> in(u.size());
  for (int i = 0; i < W.size(); ++i) in[i] = u[i][0] < -W.rest[i];
  return saltus::parts_of(W.start, W.contact, [&](int k) { return !W.block[k].isZero(0); }, in);
}

/// W of some contacts.
ContactBlocks blocks_of(const ContactBlocks& W, const Part& part) {
  std::vector<int> place(static_cast<std::size_t>(W.size()), -1);
  for (std::size_t i = 0; i < part.size(); ++i) place[part[i]] = static_cast<int>(i);
  ContactBlocks out;
  for (const int j : part) {
    out.start.push_back(static_cast<int>(out.contact.size()));
    for (int k = W.start[j]; k < W.start[j + 1]; ++k) {
      if (place[W.contact[k]] < 0) continue;
      out.contact.push_back(place[W.contact[k]]);
      out.block.push_back(W.block[k]);
    }
    out.own.push_back(W.own[j]);
    out.friction.push_back(W.friction[j]);
    out.restitution.push_back(W.restitution[j]);
    out.rest.push_back(W.rest[j]);
  }
  out.start.push_back(static_cast<int>(out.contact.size()));
  return out;
}

double shared_restitution(const ContactBlocks& W, const std::vector<Vec3>& before,
                          const std::vector<Vec3>& p) {
  VecX energy(W.size());
  for (int i = 0; i < W.size(); ++i) energy[i] = p[i][0] * std::abs(before[i][0]);
  return saltus::shared_restitution(Eigen::Map<const VecX>(W.restitution.data(), W.size()), energy);
}

/// The tangential impulses of least kinetic energy with these normal ones: each in its disc, there
/// and back until none changes. Whenever it ends, no energy has been gained.
void slide_least(const ContactBlocks& W, std::vector<Vec3>& u, std::vector<Vec3>& p) {
  constexpr int most_sweeps = 1000;  // redundant contacts gain a digit in 5 to 50
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0, size = 0;
    for (int k = 0; k < 2 * W.size(); ++k) {
      const int i = k < W.size() ? k : 2 * W.size() - 1 - k;
      if (!(W.friction[i] > 0)) continue;
      const Mat2 own = W.own[i].bottomRightCorner<2, 2>();
      const Vec2 held = p[i].tail<2>();
      const Vec2 free = u[i].tail<2>() - own * held;
      const Vec2 now = least_in_disc(own, free, W.friction[i] * p[i][0]);
      add_rates(W, i, Vec3(0, now[0] - held[0], now[1] - held[1]), u);
      p[i].tail<2>() = now;
      change = std::max(change, (now - held).norm());
      size = std::max(size, p[i][0]);
    }
    if (change <= 1e-15 * size) return;
  }
}

/// Both phases of one part. Writes its impulses. @return false where no compression is found
bool collide_part(const ContactBlocks& W, double most_restitution, PileScratch& pile,
                  std::vector<Vec3>& u, std::vector<Vec3>& p) {
  const std::vector<Vec3> before = u;
  p.assign(u.size(), Vec3::Zero());
  pile.reserve(u.size());
  if (!(settle_for_sure(W, pile, u, p).excess <= large_residual)) return false;
  const double e = std::min(most_restitution, shared_restitution(W, before, p));
  if (!(e > 0)) return true;
  std::vector<Vec3> more;
  for (const Vec3& each : p) more.push_back(e * each);
  add_rates(W, more, u);
  slide_least(W, u, more);
  for (std::size_t i = 0; i < p.size(); ++i) p[i] += more[i];
  return true;
}

}  // namespace

bool collide_together(const ContactBlocks& W, int max_impulses, PileScratch& pile,
                      std::vector<Vec3>& u, std::vector<FrictionImpulse>& impulses) {
  const std::size_t first = impulses.size();
  const bool loses =
      std::any_of(W.restitution.begin(), W.restitution.end(), [](double e) { return e < 1; });
  const std::size_t plenty = 32 * static_cast<std::size_t>(W.size()) + 64;
  std::vector<Vec3> u_part, p;
  for (;;) {
    const std::vector<Part> parts = approaching_parts(W, u);
    if (parts.empty()) return true;
    const std::size_t spent = impulses.size() - first;
    if (spent >= static_cast<std::size_t>(max_impulses)) return false;
    const double most_restitution = loses && spent > plenty ? 0 : 1;
    const std::size_t before = impulses.size();
    for (const Part& part : parts) {
      const ContactBlocks own = blocks_of(W, part);
      u_part.clear();
      for (const int i : part) u_part.push_back(u[i]);
      if (part.size() == 1) {
        const double e = std::min(most_restitution, own.restitution[0]);
        p.assign(1, collide_contact(own.own[0], u_part[0], own.friction[0], e));
      } else if (!collide_part(own, most_restitution, pile, u_part, p)) {
        return false;
      }
      for (std::size_t k = 0; k < part.size(); ++k) {
        if (p[k].isZero(0)) continue;
        add_rates(W, part[k], p[k], u);
        impulses.push_back({part[k], p[k]});
      }
    }
    if (impulses.size() == before) return false;
  }
}

}  // namespace saltus
