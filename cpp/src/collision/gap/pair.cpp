#include "saltus/collision/pair.hpp"

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

}  // namespace saltus
