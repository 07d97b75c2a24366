// W of an island by the coordinates of its bodies: for pile.cpp.
//
// A contact has entries on the one or two bodies that touch, so that Newton's matrix has blocks
// where bodies touch: in an order in which neighbours are near it is a band, and a tower costs as
// much for each box as another. That of Cuthill and McKee (Proc. 24th ACM Nat. Conf., 1969).
#include <algorithm>
#include <cmath>

#include "variational/law/pile_island.hpp"

namespace saltus {

/// Lists the bodies. @return false where factors are not known, or coordinates more than rates
bool PileIsland::find_bodies() {
  if (W_.factors.empty()) return false;
  s_.body_of.resize(static_cast<std::size_t>(W_.coordinates), -1);
  s_.body_first.clear();
  s_.body_count.clear();
  int coordinates = 0;
  for (int i = 0; i < k_; ++i) {
    for (const ContactBlocks::Body& body : W_.factors[contact(i)].body) {
      if (body.count == 0 || s_.body_of[body.first] >= 0) continue;
      s_.body_of[body.first] = static_cast<int>(s_.body_first.size());
      s_.body_first.push_back(body.first);
      s_.body_count.push_back(body.count);
      coordinates += body.count;
    }
  }
  if (coordinates <= 3 * k_) {
    r_ = stride_ = coordinates;
    return true;
  }
  for (const int first : s_.body_first) s_.body_of[first] = -1;
  return false;
}

/// Writes the column where each body begins.
void PileIsland::order_bodies() {
  const int bodies = static_cast<int>(s_.body_first.size());
  const auto number = [&](const ContactBlocks::Body& b) { return s_.body_of[b.first]; };
  s_.near_begin.assign(static_cast<std::size_t>(bodies) + 1, 0);
  for (int i = 0; i < k_; ++i) {
    for (const auto& body : W_.factors[contact(i)].body) {
      if (body.count > 0) ++s_.near_begin[number(body)];
    }
  }
  for (int b = 1; b <= bodies; ++b) s_.near_begin[b] += s_.near_begin[b - 1];
  s_.near.resize(static_cast<std::size_t>(s_.near_begin[bodies]));
  for (int i = k_ - 1; i >= 0; --i) {
    for (const auto& body : W_.factors[contact(i)].body) {
      if (body.count > 0) s_.near[--s_.near_begin[number(body)]] = i;
    }
  }
  const auto degree = [&](int b) { return s_.near_begin[b + 1] - s_.near_begin[b]; };
  s_.column.assign(static_cast<std::size_t>(bodies), -1);
  s_.queue.clear();
  int column = 0;
  const auto take = [&](int b) {
    if (s_.column[b] >= 0) return;
    s_.column[b] = column;
    column += s_.body_count[b];
    s_.queue.push_back(b);
  };
  int start = 0;
  for (int b = 1; b < bodies; ++b) {
    if (degree(b) < degree(start)) start = b;
  }
  take(start);
  for (std::size_t at = 0; at < s_.queue.size(); ++at) {
    for (int e = s_.near_begin[s_.queue[at]]; e < s_.near_begin[s_.queue[at] + 1]; ++e) {
      for (const auto& body : W_.factors[contact(s_.near[e])].body) {
        if (body.count > 0) take(number(body));
      }
    }
  }
}

/// L the rates and K the responses, scaled as contacts are.
void PileIsland::take_factors() {
  for (int i = 0; i < k_; ++i) {
    const ContactBlocks::Factors& f = W_.factors[contact(i)];
    const int count = f.body[0].count + f.body[1].count;
    s_.first[i] = r_;
    s_.last[i] = 0;
    for (int rate = 0; rate < 3; ++rate) {
      row_of_L(3 * i + rate).setZero();
      row_of_K(3 * i + rate).setZero();
    }
    int from = 0;
    for (const auto& body : f.body) {
      if (body.count == 0) continue;
      const int to = s_.column[s_.body_of[body.first]];
      for (int rate = 0; rate < 3; ++rate) {
        const std::size_t at = f.begin + static_cast<std::size_t>(rate * count + from);
        for (int c = 0; c < body.count; ++c) {
          row_of_L(3 * i + rate)[to + c] = s_.scale[i] * W_.rates[at + static_cast<std::size_t>(c)];
          row_of_K(3 * i + rate)[to + c] =
              s_.scale[i] * W_.responses[at + static_cast<std::size_t>(c)];
        }
      }
      s_.first[i] = std::min(s_.first[i], to);
      s_.last[i] = std::max(s_.last[i], to + body.count);
      s_.spans[i][from == 0 ? 0 : 1] = {to, body.count};
      from += body.count;
    }
  }
  for (const int first : s_.body_first) s_.body_of[first] = -1;
}

/// Coordinates in units in which L and K are alike, as if W were L L^T: with light and heavy
/// bodies, and angles beside lengths, |F| tells then how near the solution is.
void PileIsland::balance() {
  s_.z.assign(static_cast<std::size_t>(r_), 0);
  s_.z_new.assign(static_cast<std::size_t>(r_), 0);
  for (int i = 0; i < 3 * k_; ++i) {
    const int first = s_.first[i / 3], last = s_.last[i / 3];
    for (int c = first; c < last; ++c) {
      s_.z[c] += row_of_L(i)[c] * row_of_L(i)[c];
      s_.z_new[c] += row_of_K(i)[c] * row_of_K(i)[c];
    }
  }
  for (int c = 0; c < r_; ++c) {
    s_.z[c] = s_.z[c] > 0 && s_.z_new[c] > 0 ? std::sqrt(std::sqrt(s_.z_new[c] / s_.z[c])) : 1;
  }
  for (int i = 0; i < 3 * k_; ++i) {
    for (int c = s_.first[i / 3]; c < s_.last[i / 3]; ++c) {
      row_of_L(i)[c] *= s_.z[c];
      row_of_K(i)[c] /= s_.z[c];
    }
  }
}

}  // namespace saltus
