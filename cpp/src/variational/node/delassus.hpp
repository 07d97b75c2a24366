// W of contacts: what an impulse at one changes of the rates of all. The one place that knows who
// feels whom.
#pragma once

#include <span>

#include "saltus/variational/cascade.hpp"
#include "variational/law/pile.hpp"
#include "variational/node/node.hpp"

namespace saltus {

/// Who feels whom: contacts that share a tree.
class Neighbours {
 public:
  explicit Neighbours(const Scene& scene);

  /// Of `count` contacts with rows row(i).
  template <class RowOf>
  void list(int count, const RowOf& row) {
    for (auto& each : on_) each.clear();
    for (int i = 0; i < count; ++i) {
      for (const ContactVector::Part& part : row(i).part) {
        if (part.tree >= 0) on_[part.tree].push_back(i);
      }
    }
  }
  /// Of one of them; it is one itself.
  const std::vector<int>& of(const ContactVector& row);

 private:
  std::vector<std::vector<int>> on_;  ///< (trees) contacts
  std::vector<int> found_;
};

/// Adds what W of a contact is made of: its rates and its responses, of up to three rows. Contacts
/// are added in order.
void add_factors(const TreeCoordinates& trees, std::span<const ContactVector* const> rates,
                 std::span<const ContactVector* const> responses, ContactBlocks& W);

/// Writes W and the rates u of these contacts, and their columns M^-1 [N; T]^T. Needs M and v.
void set_contact_blocks(const Scene& scene, std::span<Contact* const> contacts, Node& node,
                        Neighbours& neighbours, ContactBlocks& W, std::vector<Vec3>& u);

/// G = N M^-1 N^T of all that touches, symmetric to the last bit, and the columns M^-1 N^T.
void set_contact_matrix(const Scene& scene, Node& node, Neighbours& neighbours, ContactMatrix& G);

/// An impulse (lambda, beta) at a contact, whose columns are written: changes p and v.
void apply(const Scene& scene, const Contact& contact, const Vec3& p, Node& node);

}  // namespace saltus
