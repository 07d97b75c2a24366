// A cheap way to who presses, sticks and slides: projected steps of one contact after the other.
#include "variational/law/coulomb.hpp"
#include "variational/law/pile_island.hpp"

namespace saltus {
namespace {

/// The inverses of the normal and of the largest tangential eigenvalue of W_ii, 0 where there is
/// none: the longest steps that do not lead away from the law.
std::array<double, 2> steps_of(const Mat3& W) {
  const double a = W(1, 1), d = W(2, 2), b = (W(1, 2) + W(2, 1)) / 2;
  const double most = (a + d) / 2 + std::hypot((a - d) / 2, b);
  return {W(0, 0) > 0 ? 1 / W(0, 0) : 0, most > 0 ? 1 / most : 0};
}

/// The impulse after a step against the rates u, first along the normal and then across.
Vec3 stepped(const Mat3& W, const std::array<double, 2>& step, double friction, double bound,
             const Vec3& u, const Vec3& p) {
  const double normal = p[0] - step[0] * u[0];
  if (bound > 0) return {std::clamp(normal, -bound, bound), 0, 0};
  Vec3 out(std::max(0.0, normal), 0, 0);
  const double most = friction * out[0];
  if (!(most > 0)) return out;
  const Vec2 felt = u.tail<2>() + W.block<2, 1>(1, 0) * (out[0] - p[0]);
  const Vec2 across = p.tail<2>() - step[1] * felt;
  const double size = across.norm();
  out.tail<2>() = size > most ? Vec2(most / size * across) : across;
  return out;
}

}  // namespace

/// Where contacts are redundant it would matter who is first; there nothing is done.
bool PileIsland::has_redundant() const {
  int rates = 0;
  for (int i = 0; i < k_; ++i) rates += s_.friction[i] > 0 ? 3 : 1;
  return is_by_bodies_ || r_ < rates;
}

void PileIsland::sweep(int sweeps) {
  s_.step.clear();
  for (int i = 0; i < k_; ++i) {
    s_.step.push_back(steps_of(s_.scale[i] * s_.scale[i] * W_.own[contact(i)]));
  }
  for (int k = 0; k < sweeps; ++k) {
    for (int i = 0; i < k_; ++i) {
      const Mat3 own = s_.scale[i] * s_.scale[i] * W_.own[contact(i)];
      const Vec3 after = stepped(own, s_.step[i], s_.friction[i], s_.bound[i], s_.u[i], s_.p[i]);
      const Vec3 dp = s_.scale[i] * (after - s_.p[i]);
      if (dp.isZero(0)) continue;
      for (int e = W_.start[contact(i)]; e < W_.start[contact(i) + 1]; ++e) {
        const int at = s_.place[W_.contact[e]];
        s_.u[at] += s_.scale[at] * (W_.block[e] * dp);
      }
      s_.p[i] = after;
    }
  }
}

}  // namespace saltus
