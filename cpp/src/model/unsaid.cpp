// A warning for scenes with floors: contacts that nothing is said of.
//
// The paper's world is elastic and smooth, and so is this one unless something else is said. What
// is dropped on a floor should not be so without a word.
#include "model/assembly.hpp"

namespace saltus {

bool Assembly::is_unsaid(int i, int j) const {
  const std::vector<int>& row = m_.materials.of_shape;
  return !said_[row[i] * m_.materials.names.size() + row[j]] && m_.pairs.count(i, j) > 0;
}

/// For each link the one that flies and carries it, -1 where none does.
std::vector<int> Assembly::flying_links() const {
  std::vector<int> flying(d_.links.size(), -1);
  for (const int j : order_) {
    const int parent = link_.at(d_.joints[j].parent), child = link_.at(d_.joints[j].child);
    const bool flies = place_[parent].joint < 0 && d_.joints[j].type == JointType::floating;
    flying[child] = flies ? child : flying[parent];
  }
  return flying;
}

void Assembly::warn_of_unsaid_contacts() {
  const std::vector<int> flying = flying_links();
  const int shapes = static_cast<int>(m_.shapes.size());
  const auto is_floor = [&](int i) {
    return std::holds_alternative<HalfSpace>(m_.shapes[i].shape);
  };
  std::vector<int> falling;  // shapes of what flies and meets a floor
  std::set<int> unsaid;      // links that fly, of those that nothing is said of
  std::string floor;
  for (int i = 0; i < shapes; ++i) {
    const int link = flying[m_.shapes[i].link];
    if (link < 0) continue;
    bool falls = false;
    for (int j = 0; j < shapes; ++j) {
      if (!is_floor(j) || m_.pairs.count(i, j) == 0) continue;
      falls = true;
      if (!is_unsaid(i, j)) continue;
      unsaid.insert(link);
      if (floor.empty()) floor = m_.shapes[j].name;
    }
    if (falls) falling.push_back(i);
  }
  const std::string such = ": their contacts are elastic and without friction; ";
  const std::string say = "set_default_contact(restitution=0, friction=0.5) says otherwise, as do ";
  if (!unsaid.empty()) {
    const std::string more =
        unsaid.size() > 1 ? " (and " + std::to_string(unsaid.size() - 1) + " more)" : std::string();
    m_.warnings.push_back("nothing says what happens where " +
                          quoted(d_.links[*unsaid.begin()].name) + more + " meets " +
                          quoted(floor) + such + say +
                          "add_floor, contact= of load_urdf and --contact 0,0.5");
    return;
  }
  for (const int i : falling) {
    for (int j = 0; j < shapes; ++j) {
      if (flying[m_.shapes[j].link] == flying[m_.shapes[i].link] || !is_unsaid(i, j)) continue;
      m_.warnings.push_back(
          "the floor is said to be otherwise, but nothing says what happens where " +
          quoted(m_.shapes[i].name) + " meets " + quoted(m_.shapes[j].name) + such + say +
          "set_contact, contact= of load_urdf and --contact 0,0.5");
      return;
    }
  }
}

}  // namespace saltus
