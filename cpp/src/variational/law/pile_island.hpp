// One island of a pile: contacts that feel each other's impulses. For pile.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "variational/law/pile.hpp"

namespace saltus {

/// P(a) of Coulomb's cone, and its derivative where asked for.
Vec3 to_cone(const Vec3& a, double friction, Mat3* D = nullptr);

/// P(a) of the set that a row has: where `bound` is above 0 the interval |p| <= bound of dry
/// friction in a joint, which has one rate and no normal; else the cone.
Vec3 to_set(const Vec3& a, double friction, double bound, Mat3* D = nullptr);

using Row = Eigen::Map<Eigen::RowVectorXd>;

/// Lawlessness of scaled contacts.
struct PileResidual {
  double worst = 0, excess = 0, size = 0;
  void add(const Vec3& u, const Vec3& p, double friction, double rest, double bound) {
    const double off = (to_set(p - u, friction, bound) - p).cwiseAbs().maxCoeff();
    worst = std::max(worst, off);
    excess = std::max(excess, off - rest);
    // what friction may push is a size, too: a joint at rest has no other
    size = std::max({size, p.cwiseAbs().maxCoeff(), u.cwiseAbs().maxCoeff(), bound});
  }
  Lawlessness part() const {
    return size > 0 ? Lawlessness{worst / size, excess / size} : Lawlessness{};
  }
};

/// One island: the k contacts in s.order from `begin` on.
class PileIsland {
 public:
  PileIsland(const ContactBlocks& W, int begin, int end, PileScratch& s)
      : W_(W), begin_(begin), k_(end - begin), stride_(3 * k_), s_(s) {}

  Settled settle(double part, std::vector<Vec3>& u, std::vector<Vec3>& p);

 private:
  Settled settle_scaled(double part);
  bool take_round(double rho, double part, Settled& out);
  void set_base(double rho);
  int contact(int i) const { return s_.order[static_cast<std::size_t>(begin_ + i)]; }
  Row row_of(std::vector<double>& matrix, int i) {
    return {matrix.data() + static_cast<std::ptrdiff_t>(i) * stride_, stride_};
  }
  Row row_of_H(int c) { return {s_.H.data() + static_cast<std::ptrdiff_t>(c) * r_, r_}; }
  Row row_of_DL(int a) { return {s_.DL.data() + static_cast<std::ptrdiff_t>(a) * r_, r_}; }
  Row row_of_L(int i) { return row_of(s_.L, i); }
  Row row_of_K(int i) { return row_of(s_.K, i); }
  void set_sizes();
  bool has_redundant() const;
  void sweep(int sweeps);
  void set_W();
  void factorize();
  bool find_bodies();
  void order_bodies();
  void take_factors();
  void balance();
  void set_ends();
  /// Calls f(first, count) for the columns of a contact.
  template <class F>
  void for_each_span(int i, const F& f) const {
    for (const PileScratch::Span& span : s_.spans[i]) {
      if (span.count > 0) f(span.first, span.count);
    }
  }
  void add_rate(int i, int rate);
  void feel(const std::vector<Vec3>& dp);
  PileResidual residual() const;
  double set_F(double rho, const std::vector<double>& z, std::vector<double>& F);
  void set_slope(double rho);
  void set_row_slopes(double rho, const Mat3& D, int i, int first, int n);
  void add_to_slope(int i, int c, int first, int n);
  bool solve_slope();
  void eliminate(int c, int end);
  int solve_round(double rho, double precision, bool& ended);
  double size_of_impulses();

  const ContactBlocks& W_;
  int begin_, k_;              ///< contacts
  int stride_;                 ///< of rows
  int r_ = 0;                  ///< columns of L and K
  bool is_convex_ = true;      ///< no friction
  bool is_by_bodies_ = false;  ///< columns are coordinates of bodies, and rank is not known
  PileScratch& s_;
};

}  // namespace saltus
