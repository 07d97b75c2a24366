#include "variational/pile.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "variational/coulomb.hpp"

namespace saltus {
namespace {

constexpr double settled = 1e-13;      ///< residual that is rounding
constexpr double dependent = 1e-10;    ///< part of a rate's own W that does not follow from others
constexpr int most_rounds = 80;        ///< 5 to 20 are usual
constexpr int most_newton = 25;        ///< a round; 2 to 10 are usual
constexpr int most_idle = 3;           ///< stiff rounds that halve nothing
constexpr double least_rho = 1e-4, stiff_rho = 1e6, most_rho = 1e8;

using Row = Eigen::Map<Eigen::RowVectorXd>;

/// P(a), and its derivative.
Vec3 to_cone(const Vec3& a, double friction, Mat3* D = nullptr) {
  if (D) D->setZero();
  if (!(a[0] > 0)) return Vec3::Zero();
  Vec3 p(a[0], 0, 0);
  if (D) (*D)(0, 0) = 1;
  const double limit = friction * a[0], size = a.tail<2>().norm();
  if (size <= limit) {
    p.tail<2>() = a.tail<2>();
    if (D) (*D)(1, 1) = (*D)(2, 2) = 1;
    return p;
  }
  if (!(limit > 0)) return p;
  const Vec2 d = a.tail<2>() / size;
  p.tail<2>() = limit * d;
  if (D) {
    D->block<2, 1>(1, 0) = friction * d;
    D->bottomRightCorner<2, 2>() = limit / size * (Mat2::Identity() - d * d.transpose());
  }
  return p;
}

/// Lawlessness of scaled contacts.
struct Residual {
  double worst = 0, excess = 0, size = 0;
  void add(const Vec3& u, const Vec3& p, double friction, double rest) {
    const double off = (to_cone(p - u, friction) - p).cwiseAbs().maxCoeff();
    worst = std::max(worst, off);
    excess = std::max(excess, off - rest);
    size = std::max({size, p.cwiseAbs().maxCoeff(), u.cwiseAbs().maxCoeff()});
  }
  Lawlessness part() const {
    return size > 0 ? Lawlessness{worst / size, excess / size} : Lawlessness{};
  }
};

double scale_of(const Mat3& own) { return 1 / std::sqrt(own.diagonal().maxCoeff()); }

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

/// One island: the k contacts in s.order from `begin` on.
class Island {
 public:
  Island(const ContactBlocks& W, int begin, int end, PileScratch& s)
      : W_(W), begin_(begin), k_(end - begin), s_(s) {}

  Settled settle(std::vector<Vec3>& u, std::vector<Vec3>& p);

 private:
  Settled settle_scaled();
  int contact(int i) const { return s_.order[static_cast<std::size_t>(begin_ + i)]; }
  Row row_of_L(int i) { return {s_.L.data() + static_cast<std::ptrdiff_t>(i) * 3 * k_, 3 * k_}; }
  void set_sizes();
  void factorize();
  void add_rate(int i, int rate);
  void feel(const std::vector<Vec3>& dp);
  Lawlessness residual() const;
  double set_F(double rho, const std::vector<double>& z, std::vector<double>& F);
  void set_slope(double rho);
  bool solve_slope();
  int solve_round(double rho, bool& ended);
  void set_z();

  const ContactBlocks& W_;
  int begin_, k_, r_ = 0;
  PileScratch& s_;
};

void Island::set_sizes() {
  const auto k = static_cast<std::size_t>(k_);
  s_.place.resize(static_cast<std::size_t>(W_.size()));
  for (auto* each : {&s_.scale, &s_.friction, &s_.rest}) each->resize(k);
  for (auto* each : {&s_.first, &s_.last}) each->resize(k);
  for (auto* each : {&s_.u, &s_.p, &s_.q, &s_.base, &s_.trial}) each->resize(k);
  s_.row.resize(9 * k);
  s_.L.resize(9 * k * k);
  s_.pivot.clear();
  for (int i = 0; i < k_; ++i) {
    s_.place[contact(i)] = i;
    s_.scale[i] = scale_of(W_.own[contact(i)]);
    s_.friction[i] = W_.friction[contact(i)];
    s_.rest[i] = W_.rest.empty() ? 0 : s_.scale[i] * W_.rest[contact(i)];
  }
}

/// The row of L of a rate, and a column where it does not follow from those before.
void Island::add_rate(int i, int rate) {
  const int at = 3 * i + rate;
  Row x = row_of_L(at);
  const double* w = s_.row.data() + static_cast<std::ptrdiff_t>(rate) * 3 * k_;
  const double own = w[at];
  double left = own;
  int from = r_;
  for (int c = 0; c < r_; ++c) {
    const int pivot = s_.pivot[c];
    double value = w[pivot];
    const int begin = std::max(from, s_.first[pivot / 3]);
    const Row y = row_of_L(pivot);
    if (begin < c) value -= x.segment(begin, c - begin).dot(y.segment(begin, c - begin));
    x[c] = value == 0 ? 0 : value / y[c];
    if (value == 0) continue;
    from = std::min(from, c);
    left -= x[c] * x[c];
  }
  s_.first[i] = std::min(s_.first[i], from);
  if (!(left > dependent * own) || !(own > 1e-20)) return;
  x[r_] = std::sqrt(left);
  s_.first[i] = std::min(s_.first[i], r_);
  s_.pivot.push_back(at);
  ++r_;
}

/// W = L L^T by rows, in the order of contacts: L has the bands that W has.
void Island::factorize() {
  for (int i = 0; i < k_; ++i) {
    std::fill(s_.row.begin(), s_.row.end(), 0.0);
    const int c = contact(i);
    for (int e = W_.start[c]; e < W_.start[c + 1]; ++e) {
      const int j = s_.place[W_.contact[e]];
      for (int rate = 0; rate < 3; ++rate) {
        for (int of = 0; of < 3; ++of) {
          s_.row[static_cast<std::size_t>(3 * (rate * k_ + j) + of)] =
              s_.scale[i] * s_.scale[j] * W_.block[e](of, rate);
        }
      }
    }
    s_.first[i] = r_;
    for (int rate = 0; rate < 3; ++rate) row_of_L(3 * i + rate).setZero();
    for (int rate = 0; rate < 3; ++rate) add_rate(i, rate);
    s_.last[i] = r_;
  }
  const auto r = static_cast<std::size_t>(r_);
  for (auto* each : {&s_.z, &s_.z_new, &s_.dz, &s_.F, &s_.F_new}) each->resize(r);
  s_.H.resize(r * r);
  s_.DL.resize(3 * r);
}

/// s.u += W dp
void Island::feel(const std::vector<Vec3>& dp) {
  for (int i = 0; i < k_; ++i) {
    if (dp[i].isZero(0)) continue;
    const int c = contact(i);
    for (int e = W_.start[c]; e < W_.start[c + 1]; ++e) {
      const int j = s_.place[W_.contact[e]];
      s_.u[j] += s_.scale[i] * s_.scale[j] * (W_.block[e] * dp[i]);
    }
  }
}

Lawlessness Island::residual() const {
  Residual sum;
  for (int i = 0; i < k_; ++i) sum.add(s_.u[i], s_.p[i], s_.friction[i], s_.rest[i]);
  return sum.part();
}

void Island::set_z() {
  Eigen::Map<Eigen::RowVectorXd> z(s_.z.data(), r_);
  z.setZero();
  for (int i = 0; i < k_; ++i) {
    const int first = s_.first[i], n = s_.last[i] - first;
    for (int rate = 0; rate < 3; ++rate) {
      z.segment(first, n) += s_.p[i][rate] * row_of_L(3 * i + rate).segment(first, n);
    }
  }
}

/// F(z); the impulses in s.q, and what they are cut from in s.trial. s.base is p_k - rho u_0.
double Island::set_F(double rho, const std::vector<double>& at, std::vector<double>& out) {
  const Eigen::Map<const Eigen::RowVectorXd> z(at.data(), r_);
  Eigen::Map<Eigen::RowVectorXd> F(out.data(), r_);
  F = z;
  for (int i = 0; i < k_; ++i) {
    const int first = s_.first[i], n = s_.last[i] - first;
    Vec3 a = s_.base[i];
    for (int rate = 0; rate < 3; ++rate) {
      a[rate] -= rho * row_of_L(3 * i + rate).segment(first, n).dot(z.segment(first, n));
    }
    s_.trial[i] = a;
    s_.q[i] = to_cone(a, s_.friction[i]);
    for (int rate = 0; rate < 3; ++rate) {
      F.segment(first, n) -= s_.q[i][rate] * row_of_L(3 * i + rate).segment(first, n);
    }
  }
  return F.norm();
}

/// H = 1 + rho L^T P' L at s.trial.
void Island::set_slope(double rho) {
  std::fill(s_.H.begin(), s_.H.end(), 0.0);
  for (int c = 0; c < r_; ++c) s_.H[static_cast<std::size_t>(c) * r_ + c] = 1;
  for (int i = 0; i < k_; ++i) {
    Mat3 D;
    to_cone(s_.trial[i], s_.friction[i], &D);
    if (D.isZero(0)) continue;
    const int first = s_.first[i], n = s_.last[i] - first;
    for (int a = 0; a < 3; ++a) {
      Row x(s_.DL.data() + static_cast<std::ptrdiff_t>(a) * r_, n);
      x.setZero();
      for (int b = 0; b < 3; ++b) {
        if (D(a, b) != 0) x += rho * D(a, b) * row_of_L(3 * i + b).segment(first, n);
      }
    }
    for (int a = 0; a < 3; ++a) {
      const Row x(s_.DL.data() + static_cast<std::ptrdiff_t>(a) * r_, n);
      const Row l = row_of_L(3 * i + a);
      for (int c = first; c < s_.last[i]; ++c) {
        if (l[c] != 0) Row(s_.H.data() + static_cast<std::ptrdiff_t>(c) * r_ + first, n) += l[c] * x;
      }
    }
  }
}

/// dz = -H^-1 F, by elimination with pivots; rows that have nothing there are left alone.
bool Island::solve_slope() {
  const auto row = [&](int c) { return Row(s_.H.data() + static_cast<std::ptrdiff_t>(c) * r_, r_); };
  for (int c = 0; c < r_; ++c) s_.dz[c] = -s_.F[c];
  for (int c = 0; c < r_; ++c) {
    int pivot = c;
    for (int i = c + 1; i < r_; ++i) {
      if (std::abs(row(i)[c]) > std::abs(row(pivot)[c])) pivot = i;
    }
    if (!(std::abs(row(pivot)[c]) > 0)) return false;
    if (pivot != c) {
      row(c).swap(row(pivot));
      std::swap(s_.dz[c], s_.dz[pivot]);
    }
    for (int i = c + 1; i < r_; ++i) {
      const double factor = row(i)[c] / row(c)[c];
      if (factor == 0) continue;
      row(i).tail(r_ - c - 1) -= factor * row(c).tail(r_ - c - 1);
      s_.dz[i] -= factor * s_.dz[c];
    }
  }
  for (int c = r_ - 1; c >= 0; --c) {
    const Row x(s_.dz.data(), r_);
    s_.dz[c] = (s_.dz[c] - row(c).tail(r_ - c - 1).dot(x.tail(r_ - c - 1))) / row(c)[c];
  }
  return true;
}

/// Newton's method for one round, from s.z on. @return iterations
int Island::solve_round(double rho, bool& ended) {
  double f = set_F(rho, s_.z, s_.F);
  const double start = f;
  ended = false;
  for (int iteration = 0; iteration < most_newton; ++iteration) {
    const double size = Eigen::Map<Eigen::RowVectorXd>(s_.z.data(), r_).norm();
    ended = f <= 1e-14 * size || f <= 1e-8 * start;
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

/// s.u are the rates with s.p in place.
Settled Island::settle(std::vector<Vec3>& u, std::vector<Vec3>& p) {
  set_sizes();
  for (int i = 0; i < k_; ++i) {
    s_.u[i] = s_.scale[i] * u[contact(i)];
    s_.p[i] = p[contact(i)] / s_.scale[i];
  }
  const Settled out = settle_scaled();
  for (int i = 0; i < k_; ++i) {
    u[contact(i)] = s_.u[i] / s_.scale[i];
    p[contact(i)] = s_.p[i] * s_.scale[i];
  }
  return out;
}

Settled Island::settle_scaled() {
  Settled out{residual(), 0};
  if (out.residual <= settled) return out;
  // far from the law softly, near it not
  double rho = std::clamp(1e-3 / out.residual, 1.0, 1e4), best = out.residual;
  int idle = 0;
  factorize();
  for (int round = 0; round < most_rounds && out.residual > settled && rho >= least_rho; ++round) {
    set_z();
    for (int i = 0; i < k_; ++i) {
      // p_k - rho u_0; what L leaves of u_0 + W p - u is rounding, and not summed up
      Vec3 Lz;
      const int first = s_.first[i], n = s_.last[i] - first;
      for (int rate = 0; rate < 3; ++rate) {
        Lz[rate] = row_of_L(3 * i + rate).segment(first, n).dot(Row(s_.z.data() + first, n));
      }
      s_.base[i] = s_.p[i] - rho * (s_.u[i] - Lz);
    }
    bool ended = false;
    out.iterations += solve_round(rho, ended);
    if (!ended) {
      rho /= 8;
      continue;
    }
    set_F(rho, s_.z, s_.F);
    for (int i = 0; i < k_; ++i) s_.trial[i] = s_.q[i] - s_.p[i];
    feel(s_.trial);
    s_.p.swap(s_.q);
    static_cast<Lawlessness&>(out) = residual();
    if (out.residual < best / 2) {
      best = out.residual;
      idle = 0;
    } else if (out.residual < 1e-11 || (rho > stiff_rho && ++idle == most_idle)) {
      break;  // rounding, or rates that no impulses can end
    }
    rho = std::min(4 * rho, most_rho);
  }
  return out;
}

}  // namespace

void PileScratch::reserve(std::size_t k) {
  for (auto* each : {&island, &order, &place, &first, &last}) each->reserve(k);
  for (auto* each : {&scale, &friction, &rest}) each->reserve(k);
  for (auto* each : {&u, &p, &q, &base, &trial}) each->reserve(k);
  for (auto* each : {&z, &z_new, &dz, &F, &F_new}) each->reserve(3 * k);
  for (auto* each : {&row, &DL}) each->reserve(9 * k);
  for (auto* each : {&L, &H}) each->reserve(9 * k * k);
  pivot.reserve(3 * k);
}

Lawlessness lawlessness(const ContactBlocks& W, const std::vector<Vec3>& u,
                        const std::vector<Vec3>& p) {
  Residual sum;
  for (int i = 0; i < W.size(); ++i) {
    const double scale = scale_of(W.own[i]);
    sum.add(scale * u[i], p[i] / scale, W.friction[i], scale * W.rest[i]);
  }
  return sum.part();
}

Settled settle_pile(const ContactBlocks& W, PileScratch& s, std::vector<Vec3>& u,
                    std::vector<Vec3>& p) {
  Settled out;
  sort_by_island(W, s);
  const int m = W.size();
  for (int begin = 0, end = 0; begin < m; begin = end) {
    while (end < m && s.island[s.order[end]] == s.island[s.order[begin]]) ++end;
    Island island(W, begin, end, s);
    const Settled one = island.settle(u, p);
    out.residual = std::max(out.residual, one.residual);
    out.excess = std::max(out.excess, one.excess);
    out.iterations += one.iterations;
  }
  return out;
}

}  // namespace saltus
