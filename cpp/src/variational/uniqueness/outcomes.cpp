#include "saltus/variational/outcomes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "saltus/error.hpp"
#include "variational/law/contact_problem.hpp"
#include "variational/law/contact_qp.hpp"

namespace saltus {
namespace {

/// Rates that differ by this part of the tolerance are one velocity. An impulse changes its own by
/// (1 + e) |u| >= tolerance, so that no impulse leads to the velocity that it left.
constexpr double same_velocity = 1e-2;

/// A velocity on the way. u says all of it: what u does not see, impulses do not change.
struct Visited {
  VecX u;      ///< (m) gap rates by |v|_M sqrt(G_ii)
  int parent;  ///< -1 for the first
  int contact;
  double lambda;  ///< by |v|_M / sqrt(G_ii)
  bool open;      ///< on the way from the first to where the search is
  int next = 0;   ///< contacts below this one have been tried
};

/// What is searched, with rates and impulses scaled so that G has ones on its diagonal.
struct Search {
  const OutcomesOptions& options;
  VecX e;                               ///< (m)
  Eigen::MatrixXd G;                    ///< (m, m)
  VecX direction;                       ///< (m) |direction|_1 = 1
  std::vector<Visited> visited;         ///< a tree
  std::multimap<double, int> by_place;  ///< u . direction of each: near ones are near in this
  std::vector<int> ends;                ///< those where no contact approaches
};

/// The velocity that was met before, or -1. |u - w| <= d for all entries has |(u - w) . direction|
/// <= d, so that no border between bins can part two that are one.
int find(const Search& s, const VecX& u) {
  const double near = same_velocity * s.options.tolerance, place = u.dot(s.direction);
  const auto last = s.by_place.upper_bound(place + near);
  for (auto it = s.by_place.lower_bound(place - near); it != last; ++it) {
    if ((s.visited[it->second].u - u).cwiseAbs().maxCoeff() <= near) return it->second;
  }
  return -1;
}

void add(Search& s, VecX u, int parent, int contact, double lambda) {
  s.by_place.emplace(u.dot(s.direction), static_cast<int>(s.visited.size()));
  s.visited.push_back({std::move(u), parent, contact, lambda, true});
}

/// The first contact from `from` on that approaches, or m.
int next_approaching(const VecX& u, int from, double tolerance) {
  int i = from;
  while (i < u.size() && u[i] >= -tolerance) ++i;
  return i;
}

[[noreturn]] void out_of_bounds(const Search& s, const char* bound, long value) {
  std::ostringstream text;
  if (s.e.minCoeff() == 1 && cone_interior(s.G) == 0) {
    text << "no velocity opens all " << s.e.size() << " gaps: bodies jammed between others; "
         << s.visited.size() << " velocities were met and there may be no end";
    throw JammedError(text.str(), 0, s.visited.back().u.minCoeff(),
                      static_cast<int>(s.visited.size()));
  }
  text << "the orders of impulses on " << s.e.size() << " contacts lead to more than " << bound
       << " = " << value << (bound[4] == 's' ? " velocities" : " outcomes") << ": raise " << bound
       << ", or ask classify_impact";
  throw ModelError(text.str());
}

[[noreturn]] void refuse_cycle(const Search& s, int at, int back) {
  int length = 1;
  for (; at != back; at = s.visited[at].parent) ++length;
  std::ostringstream text;
  text << "an order of impulses leads back, by " << length
       << " impulses, to a velocity that it has come from: bodies jammed between others";
  throw JammedError(text.str(), 0, s.visited[back].u.minCoeff(), length);
}

/// Depth first, with the tree as its own stack.
void search(Search& s) {
  for (int at = 0; at >= 0;) {
    const int i = next_approaching(s.visited[at].u, s.visited[at].next, s.options.tolerance);
    if (i == s.e.size()) {
      if (s.visited[at].next == 0) {
        s.ends.push_back(at);
        if (static_cast<long>(s.ends.size()) > s.options.max_outcomes) {
          out_of_bounds(s, "max_outcomes", s.options.max_outcomes);
        }
      }
      s.visited[at].open = false;
      at = s.visited[at].parent;
      continue;
    }
    s.visited[at].next = i + 1;
    VecX u = s.visited[at].u;
    const double u_i = u[i], lambda = -(1 + s.e[i]) * u_i;
    u += s.G.col(i) * lambda;
    u[i] = -s.e[i] * u_i;
    const int met = find(s, u);
    if (met >= 0) {
      if (s.visited[met].open) refuse_cycle(s, at, met);
      continue;
    }
    if (static_cast<long>(s.visited.size()) >= s.options.max_states) {
      out_of_bounds(s, "max_states", s.options.max_states);
    }
    add(s, std::move(u), at, i, lambda);
    at = static_cast<int>(s.visited.size()) - 1;
  }
}

/// The way to an end, and on from there where weak contacts have waited.
ImpactOutcome outcome(const Search& s, int end, const ContactProblem& problem, const VecRef& v) {
  ImpactOutcome out{v, {}};
  const VecX root = problem.G.diagonal().cwiseSqrt();
  for (int at = end; s.visited[at].parent >= 0; at = s.visited[at].parent) {
    const int i = s.visited[at].contact;
    out.impulses.push_back({i, s.visited[at].lambda * problem.speed / root[i]});
  }
  std::reverse(out.impulses.begin(), out.impulses.end());
  VecX u = problem.speed * root.cwiseProduct(s.visited[end].u);
  const CascadeOptions options{.order = ImpactOrder::index, .max_impulses = 100000};
  if (!cascade(problem.G, u, problem.rest, s.e, options, out.impulses)) {
    throw JammedError("impulses below the tolerance do not end: bodies jammed between others", 0,
                      u.minCoeff(), options.max_impulses);
  }
  for (const Impulse& impulse : out.impulses) {
    out.v += problem.columns.col(impulse.pair) * impulse.lambda;
  }
  return out;
}

void check_options(const OutcomesOptions& options) {
  std::ostringstream text;
  if (options.max_outcomes < 1) {
    text << "max_outcomes " << options.max_outcomes << " is less than 1";
  } else if (options.max_states < 1 || options.max_states > 1000000000) {
    text << "max_states " << options.max_states << " is outside [1, 1e9]";
  } else if (!(options.tolerance >= 1e-12 && options.tolerance <= 1e-3)) {
    text << "tolerance " << options.tolerance << " is outside [1e-12, 1e-3]";
  }
  if (!text.str().empty()) throw ModelError(text.str());
}

Search prepared(const ContactProblem& problem, const VecRef& restitution,
                const OutcomesOptions& options) {
  const auto m = restitution.size();
  const VecX root = problem.G.diagonal().cwiseSqrt();
  Search s{options, restitution, {}, VecX(m), {}, {}, {}};
  s.G = root.cwiseInverse().asDiagonal() * problem.G * root.cwiseInverse().asDiagonal();
  // any direction but that of a symmetry, which would hold different velocities for near ones
  for (Eigen::Index i = 0; i < m; ++i) s.direction[i] = 1 + std::sin(1. + static_cast<double>(i));
  s.direction /= s.direction.lpNorm<1>();
  add(s, problem.u.cwiseQuotient(root) / problem.speed, -1, -1, 0);
  return s;
}

}  // namespace

ImpactOutcomes impact_outcomes(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                               const VecRef& v, const VecRef& restitution,
                               const OutcomesOptions& options) {
  check_options(options);
  const ContactProblem problem = contact_problem(M, N, v, restitution);
  ImpactOutcomes out{{}, 0, 0, 1};
  if ((problem.u.array() >= -problem.rest.array()).all()) {
    out.outcomes.push_back({v, {}});
    return out;
  }
  if ((restitution.array() == 0).all()) {
    out.outcomes.push_back(resolve_impact(M, N, v, restitution));
    out.states = 2;
    return out;
  }
  Search s = prepared(problem, restitution, options);
  search(s);
  out.states = static_cast<long>(s.visited.size());
  for (const int end : s.ends) {
    ImpactOutcome each = outcome(s, end, problem, v);
    double nearest = problem.speed;
    for (const ImpactOutcome& other : out.outcomes) {
      const VecX apart = each.v - other.v;
      const double distance = std::sqrt(apart.dot(M * apart));
      nearest = std::min(nearest, distance);
      out.spread = std::max(out.spread, distance);
    }
    if (nearest > options.tolerance * problem.speed || out.outcomes.empty()) {
      out.outcomes.push_back(std::move(each));
    }
  }
  out.relative_spread = out.spread / problem.speed;
  return out;
}

ImpactOutcomes impact_outcomes(const Eigen::Ref<const MatX>& M, const Eigen::Ref<const MatX>& N,
                               const VecRef& v, double restitution,
                               const OutcomesOptions& options) {
  return impact_outcomes(M, N, v, VecX(VecX::Constant(N.rows(), restitution)), options);
}

}  // namespace saltus
