// Rows phi_q and columns M^-1 phi_q^T of contacts: zero but on the one or two trees that touch, and
// on those that loops or forces tie to them.
//
// M is block diagonal, a block a tree, so a column lives where its row does, and contacts that
// share no tree do not know of each other.
#pragma once

#include <array>
#include <vector>

#include "saltus/lagrangian/packed_matrix.hpp"
#include "saltus/model/model.hpp"

namespace saltus {

/// Coordinates that feel each other, by lists: those of a tree, in order of position, or of several
/// that loops or forces tie together; one list of all with mimic joints, which tie trees, too.
struct TreeCoordinates {
  explicit TreeCoordinates(const ModelData& model);
  std::vector<std::vector<int>> of;  ///< (lists)
  std::vector<int> list;             ///< (trees) the list that a tree is in
  std::vector<char> is_tied;         ///< (lists) of several trees
  std::vector<int> first;            ///< (lists + 1) where its coordinates are numbered from
  bool one_to_one;                   ///< no mimic joints
  int most = 0;                      ///< entries of the longest list
};

struct ContactVector {
  struct Part {
    int tree = -1;  ///< none
    int first = 0, count = 0;
  };
  std::array<Part, 2> part;
  std::vector<double> value;
};

/// Where not, an impulse along one is not felt by the other.
bool share_a_tree(const ContactVector& x, const ContactVector& y);

/// Parts of a pair's row, all zero.
void shape_row(const ModelData& model, const TreeCoordinates& trees, const Pair& pair,
               ContactVector& row);

/// Takes the row's entries out of `dense` (n_v), and leaves zeros there.
void take_from(const TreeCoordinates& trees, VecX& dense, ContactVector& row);

double dot(const TreeCoordinates& trees, const ContactVector& row, const VecX& x);
double dot(const ContactVector& row, const ContactVector& column);
/// The largest |x_k| where the row may have entries.
double largest(const TreeCoordinates& trees, const ContactVector& row, const VecX& x);
/// sum |row_k x_k|
double dot_sizes(const TreeCoordinates& trees, const ContactVector& row, const VecX& x);
/// x += factor row
void add(const TreeCoordinates& trees, double factor, const ContactVector& row, VecX& x);
/// x += |factor row|
void add_sizes(const TreeCoordinates& trees, double factor, const ContactVector& row, VecX& x);
/// column <- J^-1 row; M^-1 row where J is that of no duration
void solve(const ModelData& model, const TreeCoordinates& trees, const ContactVector& row,
           PackedMatrix& J, VecX& scratch, ContactVector& column);
/// row <- K^T row, `pull_back_end` of packed_matrix.hpp
void pull_back_end(const ModelData& model, const TreeCoordinates& trees, const PackedMatrix& J,
                   VecX& scratch, ContactVector& row);

}  // namespace saltus
