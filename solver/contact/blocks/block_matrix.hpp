#pragma once

#include <span>
#include <vector>

#include "solver/contact/problem/whitening.hpp"

namespace cupola {

/// Pairs of blocks that touch: the strict lower triangle of a symmetric matrix of 6x6 blocks, by columns.
struct BlockPattern {
  std::vector<int> column_start;  ///< (nb + 1)
  std::vector<int> row;           ///< row block, ascending within a column (num_pairs)
  bool plane = false;             ///< see ContactProblem::plane
  int num_blocks() const { return static_cast<int>(column_start.size()) - 1; }
  int num_pairs() const { return static_cast<int>(row.size()); }
  bool operator==(const BlockPattern&) const = default;
};

/// Rows of a 6x6 block that are unknowns: all, or x, z and rot y in the plane.
std::span<const int> unknowns_of_block(const BlockPattern& pattern);

/// Symmetric matrix of 6x6 blocks with a given pattern.
struct BlockMatrix {
  std::vector<Mat6> diagonal;  ///< (nb)
  std::vector<Mat6> lower;     ///< block (row, column), row > column, of each pair (num_pairs)
};

/// The pattern of D D^T, and the pair that each contact contributes to.
struct ContactGraph {
  BlockPattern pattern;
  std::vector<int> pair_of_contact;  ///< -1 if one side is fixed, or both are the same block (nc)
};
ContactGraph contact_graph(const ContactProblem& problem);

/// M + sum_i D_i G_i D_i^T, summed in the order of the contacts.
BlockMatrix assemble_hessian(const ContactProblem& problem, const ContactGraph& graph,
                             const std::vector<Mat3>& G);

/// In whitened unknowns, sum_i J_i G_i J_i^T.
BlockMatrix assemble_stiffness(const WhitenedProblem& problem, const ContactGraph& graph,
                               const std::vector<Mat3>& G);
/// I + assemble_stiffness().
BlockMatrix assemble_hessian(const WhitenedProblem& problem, const ContactGraph& graph,
                             const std::vector<Mat3>& G);

/// Matrix times vector (6 nb).
VecX multiply(const BlockPattern& pattern, const BlockMatrix& matrix, const VecX& x);

}  // namespace cupola
