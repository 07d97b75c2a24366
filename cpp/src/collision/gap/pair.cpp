#include "saltus/collision/pair.hpp"

#include <algorithm>
#include <cmath>

namespace saltus {

std::vector<ChainJoint> chain_between(const Tree& tree, int joint_b, int joint_a) {
  std::vector<ChainJoint> chain, branch_a;
  while (joint_a != joint_b) {  // parents have smaller indices: always step up from the deeper
    if (joint_b > joint_a) {
      chain.push_back({joint_b, -1});
      joint_b = tree.parent[joint_b];
    } else {
      branch_a.push_back({joint_a, +1});
      joint_a = tree.parent[joint_a];
    }
  }
  chain.insert(chain.end(), branch_a.rbegin(), branch_a.rend());
  return chain;
}

Pair make_stop(const Tree& tree, int joint, const Stop& stop) {
  Pair pair;
  pair.stop = stop;
  pair.kind = Whole{};
  pair.on_a.joint = joint;
  pair.on_b.joint = tree.parent[joint];
  pair.chain = {{joint, +1}};
  pair.touch = relative_touch * std::max(1.0, std::abs(stop.bound));
  return pair;
}

}  // namespace saltus
