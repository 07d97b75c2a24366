#include "variational/law/pile_island.hpp"

#include "variational/law/coulomb.hpp"

namespace saltus {
namespace {

/// Room for so many numbers, whatever they are: they are written before they are read.
void grow(std::size_t size, std::vector<double>& x) {
  if (x.size() < size) x.resize(size);
}

constexpr double dependent = 1e-10;  ///< part of a rate's own W that does not follow from others

}  // namespace

Vec3 to_cone(const Vec3& a, double friction, Mat3* D) {
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

Vec3 to_set(const Vec3& a, double friction, double bound, Mat3* D) {
  if (!(bound > 0)) return to_cone(a, friction, D);
  const bool is_inside = std::abs(a[0]) < bound;
  if (D) D->setZero();
  if (D && is_inside) (*D)(0, 0) = 1;
  return {std::clamp(a[0], -bound, bound), 0, 0};
}

void PileIsland::set_sizes() {
  const auto k = static_cast<std::size_t>(k_);
  s_.place.resize(static_cast<std::size_t>(W_.size()));
  for (auto* each : {&s_.scale, &s_.friction, &s_.rest, &s_.bound}) each->resize(k);
  for (auto* each : {&s_.first, &s_.last}) each->resize(k);
  s_.spans.assign(k, {});
  for (auto* each : {&s_.u, &s_.p, &s_.q, &s_.base, &s_.trial}) each->resize(k);
  s_.pivot.clear();
  for (int i = 0; i < k_; ++i) {
    s_.place[contact(i)] = i;
    s_.scale[i] = scale_of(W_.own[contact(i)]);
    s_.friction[i] = W_.friction[contact(i)];
    s_.bound[i] = W_.bound_of(contact(i)) / s_.scale[i];
    is_convex_ = is_convex_ && !(s_.friction[i] > 0);
    s_.rest[i] = W_.rest.empty() ? 0 : s_.scale[i] * W_.rest[contact(i)];
  }
}

/// W by rows, scaled.
void PileIsland::set_W() {
  const auto size = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(stride_);
  grow(size, s_.W);
  std::fill_n(s_.W.begin(), size, 0.0);
  for (int by = 0; by < k_; ++by) {
    const int c = contact(by);
    for (int e = W_.start[c]; e < W_.start[c + 1]; ++e) {
      const int at = s_.place[W_.contact[e]];
      for (int rate = 0; rate < 3; ++rate) {
        row_of(s_.W, 3 * at + rate).segment<3>(3 * by) =
            s_.scale[at] * s_.scale[by] * W_.block[e].row(rate);
      }
    }
  }
}

/// The rows of L and K of a rate, and a column where it does not follow from those before.
void PileIsland::add_rate(int i, int rate) {
  const int at = 3 * i + rate;
  Row x = row_of_L(at), y = row_of_K(at);
  const double own = row_of(s_.W, at)[at];
  double left = own;
  int from = r_;
  for (int c = 0; c < r_; ++c) {
    const int pivot = s_.pivot[c];
    const int begin = std::max(std::min(from, c), s_.first[pivot / 3]), n = std::max(c - begin, 0);
    double feels = row_of(s_.W, at)[pivot], felt = row_of(s_.W, pivot)[at];
    feels -= x.segment(begin, n).dot(row_of_K(pivot).segment(begin, n));
    felt -= y.segment(begin, n).dot(row_of_L(pivot).segment(begin, n));
    x[c] = y[c] = 0;
    if (feels == 0 && felt == 0) continue;
    x[c] = feels / row_of_K(pivot)[c];
    y[c] = felt / row_of_L(pivot)[c];
    from = std::min(from, c);
    left -= x[c] * y[c];
  }
  s_.first[i] = std::min(s_.first[i], from);
  if (!(left > dependent * own) || !(own > 1e-20)) return;
  x[r_] = y[r_] = std::sqrt(left);
  s_.first[i] = std::min(s_.first[i], r_);
  s_.pivot.push_back(at);
  ++r_;
}

/// W = L K^T by rows: with coordinates of bodies as columns, where these are few and known; else in
/// the order of contacts, L and K with the bands that W has.
void PileIsland::factorize() {
  is_by_bodies_ = find_bodies();
  const auto rates = static_cast<std::size_t>(3 * k_);
  for (auto* each : {&s_.L, &s_.K}) grow(rates * static_cast<std::size_t>(stride_), *each);
  if (is_by_bodies_) {
    order_bodies();
    take_factors();
    balance();
  } else {
    set_W();
    for (int i = 0; i < k_; ++i) {
      s_.first[i] = r_;
      for (int rate = 0; rate < 3; ++rate) {  // columns that later rates of the contact may add
        const int most = std::min(3, stride_ - r_);
        row_of_L(3 * i + rate).segment(r_, most).setZero();
        row_of_K(3 * i + rate).segment(r_, most).setZero();
      }
      for (int rate = 0; rate < 3; ++rate) add_rate(i, rate);
      s_.last[i] = r_;
      s_.spans[i][0] = {s_.first[i], r_ - s_.first[i]};
    }
  }
  const auto r = static_cast<std::size_t>(r_);
  for (auto* each : {&s_.z, &s_.z_new, &s_.dz, &s_.F, &s_.F_new}) each->resize(r);
  grow(r * r, s_.H);
  s_.DL.resize(3 * r);
  set_ends();
}

/// Rows of H reach as far as the contacts that they take part in.
void PileIsland::set_ends() {
  s_.ends.assign(static_cast<std::size_t>(r_), 0);
  for (int i = 0; i < k_; ++i) {
    for (int c = s_.first[i]; c < s_.last[i]; ++c) s_.ends[c] = std::max(s_.ends[c], s_.last[i]);
  }
}

/// s.u += W dp
void PileIsland::feel(const std::vector<Vec3>& dp) {
  for (int i = 0; i < k_; ++i) {
    if (dp[i].isZero(0)) continue;
    const int c = contact(i);
    for (int e = W_.start[c]; e < W_.start[c + 1]; ++e) {
      const int j = s_.place[W_.contact[e]];
      s_.u[j] += s_.scale[i] * s_.scale[j] * (W_.block[e] * dp[i]);
    }
  }
}

PileResidual PileIsland::residual() const {
  PileResidual sum;
  for (int i = 0; i < k_; ++i) {
    sum.add(s_.u[i], s_.p[i], s_.friction[i], s_.rest[i], s_.bound[i]);
  }
  return sum;
}

/// |K^T p|
double PileIsland::size_of_impulses() {
  Eigen::Map<Eigen::RowVectorXd> sum(s_.F.data(), r_);
  sum.setZero();
  for (int i = 0; i < k_; ++i) {
    for_each_span(i, [&](int first, int n) {
      for (int rate = 0; rate < 3; ++rate) {
        sum.segment(first, n) += s_.p[i][rate] * row_of_K(3 * i + rate).segment(first, n);
      }
    });
  }
  return sum.norm();
}

/// F(z); the impulses in s.q, and what they are cut from in s.trial. s.base is p_k - rho u_k.
double PileIsland::set_F(double rho, const std::vector<double>& at, std::vector<double>& out) {
  const Eigen::Map<const Eigen::RowVectorXd> z(at.data(), r_);
  Eigen::Map<Eigen::RowVectorXd> F(out.data(), r_);
  F = z;
  for (int i = 0; i < k_; ++i) {
    Vec3 a = s_.base[i];
    for_each_span(i, [&](int first, int n) {
      for (int rate = 0; rate < 3; ++rate) {
        a[rate] -= rho * row_of_L(3 * i + rate).segment(first, n).dot(z.segment(first, n));
      }
    });
    s_.trial[i] = a;
    s_.q[i] = to_set(a, s_.friction[i], s_.bound[i]);
    const Vec3 dp = s_.q[i] - s_.p[i];
    if (dp.isZero(0)) continue;
    for_each_span(i, [&](int first, int n) {
      for (int rate = 0; rate < 3; ++rate) {
        F.segment(first, n) -= dp[rate] * row_of_K(3 * i + rate).segment(first, n);
      }
    });
  }
  return F.norm();
}

}  // namespace saltus
