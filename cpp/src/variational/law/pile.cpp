#include <algorithm>
#include <cmath>
#include <numeric>

#include "variational/law/pile_island.hpp"

namespace saltus {
namespace {

constexpr double settled = 1e-15;  ///< residual that is rounding
constexpr int most_rounds = 80;    ///< 5 to 20 are usual
constexpr int most_newton = 25;    ///< a round; 2 to 10 are usual
constexpr int most_idle = 40;      ///< rounds that halve nothing
constexpr double unknown = 1e-5;   ///< residual of impulses by contacts that do other than they did
constexpr double known = 1e-7;     ///< below, what each contact does is known most often
constexpr int light_sweeps = 30;   ///< as much work as one or two iterations
constexpr int few = 4;             ///< contacts that Newton's method finds the way of by itself
/// Of rho after a round that came nearer to the law, or easily so.
constexpr double growth = 4, easy_growth = 32;
/// Rounds with the same rho that end a little farther from the law, as they may on the way to it.
constexpr int most_stays = 8;
constexpr double least_rho = 1e-4, stiff_rho = 1e6, most_rho = 1e12;

int root_of(int i, std::vector<int>& island) {
  while (island[i] != i) i = island[i] = island[island[i]];
  return i;
}

/// Contacts in the order of their islands.
void sort_by_island(const ContactBlocks& W, PileScratch& s) {
  const int m = W.size();
  s.island.resize(static_cast<std::size_t>(m));
  std::iota(s.island.begin(), s.island.end(), 0);
  for (int i = 0; i < m; ++i) {
    for (int e = W.start[i]; e < W.start[i + 1]; ++e) {
      const int a = root_of(i, s.island), b = root_of(W.contact[e], s.island);
      s.island[std::max(a, b)] = std::min(a, b);
    }
  }
  for (int i = 0; i < m; ++i) s.island[i] = root_of(i, s.island);
  s.order.resize(s.island.size());
  std::iota(s.order.begin(), s.order.end(), 0);
  std::sort(s.order.begin(), s.order.end(), [&](int a, int b) {
    return s.island[a] != s.island[b] ? s.island[a] < s.island[b] : a < b;
  });
}

}  // namespace

/// Newton's method for one round, from z = 0 on. @return iterations
int PileIsland::solve_round(double rho, double precision, bool& ended) {
  const double size_before = size_of_impulses();
  std::fill(s_.z.begin(), s_.z.end(), 0.0);
  double f = set_F(rho, s_.z, s_.F);
  const double start = f;
  const double enough = std::clamp(1e-2 * precision, 1e-8, 1e-5) * start;
  ended = false;
  for (int iteration = 0; iteration < most_newton; ++iteration) {
    const double size = size_before + Eigen::Map<Eigen::RowVectorXd>(s_.z.data(), r_).norm();
    ended = f <= 1e-14 * size || f <= enough;
    if (ended) return iteration;
    set_slope(rho);
    if (!solve_slope()) return iteration;
    double part = 1, after = 0;
    for (int k = 0; k < 8; ++k, part /= 2) {
      for (int c = 0; c < r_; ++c) s_.z_new[c] = s_.z[c] + part * s_.dz[c];
      after = set_F(rho, s_.z_new, s_.F_new);
      if (after < f * (1 - 1e-4 * part)) break;
    }
    if (!(after < f)) {  // rounding, or a kink that Newton's direction does not lead over
      ended = f <= 1e-11 * size;
      return iteration;
    }
    s_.z.swap(s_.z_new);
    s_.F.swap(s_.F_new);
    f = after;
  }
  return most_newton;
}

Settled PileIsland::settle(double part, std::vector<Vec3>& u, std::vector<Vec3>& p) {
  set_sizes();
  for (int i = 0; i < k_; ++i) {
    s_.u[i] = s_.scale[i] * u[contact(i)];
    s_.p[i] = p[contact(i)] / s_.scale[i];
  }
  const Settled out = settle_scaled(part);
  for (int i = 0; i < k_; ++i) {
    u[contact(i)] = s_.u[i] / s_.scale[i];
    p[contact(i)] = s_.p[i] * s_.scale[i];
  }
  return out;
}

/// p_k - rho u_k.
void PileIsland::set_base(double rho) {
  for (int i = 0; i < k_; ++i) s_.base[i] = s_.p[i] - rho * s_.u[i];
}

/// p_k+1 from p_k. @return false, and nothing changed, where Newton's method does not end, or, with
/// friction, ends farther from the law. Without, rounds end at it whatever it looks like on the
/// way.
bool PileIsland::take_round(double rho, double part, Settled& out) {
  set_base(rho);
  bool ended = false;
  out.iterations += solve_round(rho, part, ended);
  if (!ended) return false;
  set_F(rho, s_.z, s_.F);
  for (int i = 0; i < k_; ++i) s_.trial[i] = s_.q[i] - s_.p[i];
  s_.u_before = s_.u;
  feel(s_.trial);
  s_.p.swap(s_.q);
  const PileResidual now = residual();
  constexpr double not_much = 3;
  if (is_convex_ || now.worst < not_much * out.worst) {
    out = {now.part(), now.worst, out.iterations};
    return true;
  }
  s_.p.swap(s_.q);
  s_.u.swap(s_.u_before);
  return false;
}

/// s.u are the rates with s.p in place.
Settled PileIsland::settle_scaled(double part) {
  const PileResidual start = residual();
  Settled out{start.part(), start.worst, 0};
  const double enough = std::max(settled, part * out.residual);
  if (out.residual <= settled) return out;
  factorize();
  if (out.residual > unknown && k_ > few && !has_redundant()) {
    sweep(light_sweeps);
    const PileResidual now = residual();
    out = {now.part(), now.worst, 0};
    if (out.residual <= enough) return out;
  }
  // far from the law softly, near it not; at once where it is known what each contact does
  const double soft = std::clamp(1e-3 / out.residual, 1.0, 1e4);
  double rho = out.residual > known && k_ > few ? soft : stiff_rho, halved = out.residual;
  int idle = 0, stays = 0;
  Settled best = out;
  s_.p_best = s_.p;
  s_.u_best = s_.u;
  for (int round = 0; round < most_rounds && out.residual > enough && rho >= least_rho; ++round) {
    const Settled before = out;
    const bool taken = take_round(rho, part, out);
    const bool grows = taken && (is_convex_ || out.residual < before.residual);
    const bool easy = out.iterations - before.iterations <= 2;
    if (!taken && out.residual < 1e-12) break;  // rounding
    if (out.residual < best.residual) {
      best = out;
      s_.p_best = s_.p;
      s_.u_best = s_.u;
    }
    if (out.residual < halved / 2) {
      halved = out.residual;
      idle = 0;
    } else if (++idle == (out.excess <= 0 || (rho > stiff_rho && !is_convex_) ? 3 : most_idle)) {
      break;  // rounding of gaps, or rates that no impulses can end
    }
    stays = taken && !grows ? stays + 1 : 0;
    if (grows) {
      rho = std::min((easy ? easy_growth : growth) * rho, most_rho);
    } else if (round == 0) {
      rho = soft;
    } else if (!taken || rho > stiff_rho || stays % most_stays == 0) {
      rho /= 8;
    }
  }
  best.iterations = out.iterations;
  s_.p.swap(s_.p_best);
  s_.u.swap(s_.u_best);
  return best;
}

void reserve(ContactBlocks& W, std::size_t contacts, std::size_t numbers) {
  W.start.reserve(contacts + 1);
  W.contact.reserve(contacts * contacts);
  W.block.reserve(contacts * contacts);
  W.own.reserve(contacts);
  W.factors.reserve(contacts);
  for (auto* each : {&W.rates, &W.responses}) each->reserve(numbers * contacts);
  for (auto* each : {&W.friction, &W.restitution, &W.rest, &W.bound}) each->reserve(contacts);
}

void clear(ContactBlocks& W) {
  clear_blocks(W);
  for (auto* each : {&W.friction, &W.restitution, &W.rest, &W.bound}) each->clear();
}

void clear_blocks(ContactBlocks& W) {
  for (auto* each : {&W.start, &W.contact}) each->clear();
  for (auto* each : {&W.block, &W.own}) each->clear();
  forget_factors(W);
}

void forget_factors(ContactBlocks& W) {
  W.factors.clear();
  for (auto* each : {&W.rates, &W.responses}) each->clear();
}

void PileScratch::reserve(std::size_t k) {
  for (auto* each : {&island, &order, &place, &first, &last}) each->reserve(k);
  for (auto* each : {&scale, &friction, &rest, &bound}) each->reserve(k);
  for (auto* each : {&u, &u_before, &u_best, &p, &p_best, &q, &base, &trial, &u_first, &p_first})
    each->reserve(k);
  step.reserve(k);
  for (auto* each : {&z, &z_new, &dz, &F, &F_new}) each->reserve(3 * k);
  DL.reserve(9 * k);
  for (auto* each : {&W, &L, &K, &H}) each->reserve(9 * k * k);
  for (auto* each : {&pivot, &ends, &reach}) each->reserve(3 * k);
  spans.reserve(k);
  for (auto* each : {&body_first, &body_count, &column, &near, &queue}) each->reserve(2 * k);
  near_begin.reserve(2 * k + 1);
}

double lawlessness_of(const ContactBlocks& W, int i, const Vec3& u, const Vec3& p) {
  const double scale = scale_of(W.own[i]);
  PileResidual one;
  one.add(scale * u, p / scale, W.friction[i], 0, W.bound_of(i) / scale);
  return one.worst;
}

void add_rates(const ContactBlocks& W, int contact, const Vec3& p, std::vector<Vec3>& u) {
  for (int k = W.start[contact]; k < W.start[contact + 1]; ++k) u[W.contact[k]] += W.block[k] * p;
}

void add_rates(const ContactBlocks& W, const std::vector<Vec3>& p, std::vector<Vec3>& u) {
  for (int i = 0; i < W.size(); ++i) add_rates(W, i, p[i], u);
}

int most_lawless(const ContactBlocks& W, const std::vector<Vec3>& u, const std::vector<Vec3>& p) {
  int most = 0;
  double worst = 0;
  for (int i = 0; i < W.size(); ++i) {
    const double each = lawlessness_of(W, i, u[i], p[i]);
    if (each > worst) worst = each, most = i;
  }
  return most;
}

Lawlessness lawlessness(const ContactBlocks& W, const std::vector<Vec3>& u,
                        const std::vector<Vec3>& p) {
  PileResidual sum;
  for (int i = 0; i < W.size(); ++i) {
    const double scale = scale_of(W.own[i]);
    sum.add(scale * u[i], p[i] / scale, W.friction[i], scale * W.rest[i], W.bound_of(i) / scale);
  }
  return sum.part();
}

Settled settle_pile(const ContactBlocks& W, PileScratch& s, std::vector<Vec3>& u,
                    std::vector<Vec3>& p, double part) {
  Settled out;
  sort_by_island(W, s);
  const int m = W.size();
  for (int begin = 0, end = 0; begin < m; begin = end) {
    while (end < m && s.island[s.order[end]] == s.island[s.order[begin]]) ++end;
    PileIsland island(W, begin, end, s);
    const Settled one = island.settle(part, u, p);
    out.residual = std::max(out.residual, one.residual);
    out.excess = std::max(out.excess, one.excess);
    out.iterations += one.iterations;
  }
  return out;
}

Settled settle_for_sure(const ContactBlocks& W, PileScratch& s, std::vector<Vec3>& u,
                        std::vector<Vec3>& p, double part) {
  const double before = lawlessness(W, u, p).residual;
  const Settled first = settle_pile(W, s, u, p, part);
  if (first.least() <= small_residual || (part > 0 && first.least() < before / 2)) return first;
  // sweeps lead out of where Newton's method turns in a circle
  const int most_sweeps = part > 0 ? 100 : 2000;  // redundant contacts gain a digit in 5 to 50
  s.u_first = u;
  s.p_first = p;
  const int sweeps = settle(W, most_sweeps, u, p);
  s.work += 9.0 * static_cast<double>(W.block.size()) * sweeps;
  Settled out = settle_pile(W, s, u, p, part);
  if (!(out.residual <= first.residual)) {  // sweeps may diverge where W has no symmetry
    out = first;
    u = s.u_first;
    p = s.p_first;
  }
  return out;
}

}  // namespace saltus
