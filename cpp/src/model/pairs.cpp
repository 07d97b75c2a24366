// Shapes in joint frames, and which pairs of them are watched.
#include <algorithm>
#include <map>

#include "model/assembly.hpp"

namespace saltus {

void Assembly::add_shapes() {
  std::map<std::string, int> count;
  for (const ModelBuilder::ShapeSpec& spec : b_.shapes_) {
    const int link =
        link_index(spec.link, "a " + shape_name(spec.shape) + " is put on", "link", spec.link);
    const Place& place = place_[link];
    std::string name = spec.name.empty() ? spec.link : spec.name;
    if (const int k = ++count[name]; k > 1) name.append("#").append(std::to_string(k));
    m_.shapes.push_back({spec.shape, place.joint, place.X_JF * spec.X_LG, link, name});
  }
  add_filter();
}

bool Assembly::is_watched(const PlacedShape& a, const PlacedShape& b) const {
  if (a.joint == b.joint || is_excluded(a.link, b.link)) return false;
  const bool floor =
      std::holds_alternative<HalfSpace>(a.shape) || std::holds_alternative<HalfSpace>(b.shape);
  return floor || !is_excluded_body(a.link, b.link);
}

void Assembly::add_pairs() {
  std::map<std::string, std::vector<std::string>> unsupported;
  const int n = static_cast<int>(m_.shapes.size());
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      const PlacedShape &a = m_.shapes[i], &b = m_.shapes[j];
      if (!is_watched(a, b)) continue;
      if (!has_gap(a.shape, b.shape)) {
        std::string kind_a = shape_name(a.shape), kind_b = shape_name(b.shape);
        if (kind_b < kind_a) std::swap(kind_a, kind_b);
        unsupported[kind_a + "-" + kind_b].push_back(a.name + " ~ " + b.name);
        continue;
      }
      const bool swap = !std::holds_alternative<Sphere>(a.shape);
      Pair pair{swap ? j : i, swap ? i : j, {}, 0};
      pair.chain = chain_between(m_.tree, m_.shapes[pair.b].joint, m_.shapes[pair.a].joint);
      // epsilon_phi: 1e-10 of the smaller shape is far above the rounding of positions (1e-16 of
      // the scene) and far below what anybody can see
      pair.touch = 1e-10 * std::min(feature_size(a.shape), feature_size(b.shape));
      m_.pairs.push_back(std::move(pair));
    }
  }
  for (const auto& [kinds, names] : unsupported) {
    m_.warnings.push_back("no gap function for " + kinds +
                          " pairs; these pass through each other: " + list_names(names));
  }
}

}  // namespace saltus
