#pragma once

#include <vector>

#include "solver/contact/blocks/block_matrix.hpp"

namespace cupola {

/// Unsymmetric matrix of 6x6 blocks with a symmetric pattern.
struct UnsymmetricBlockMatrix {
  std::vector<Mat6> diagonal;  ///< (nb)
  std::vector<Mat6> lower;     ///< block (row, column), row > column, of each pair (num_pairs)
  std::vector<Mat6> upper;     ///< block (column, row) of each pair (num_pairs)
};

/// I + sum_i J_i G_i J_i^T of one problem for a sequence of unsymmetric G. Only the 6x6 blocks with a contact
/// whose G has changed are summed anew, on num_threads() threads, each in the order of the contacts: the bits
/// depend neither on their number nor on the sequence.
class ContactJacobian {
 public:
  ContactJacobian(const WhitenedProblem& problem, const ContactGraph& graph);
  const UnsymmetricBlockMatrix& at(const std::vector<Mat3>& G);

 private:
  void mark_changed(const std::vector<Mat3>& G);
  void sum_marked();
  void whiten_marked();

  const WhitenedProblem& white_;
  const ContactProblem& problem_;
  const ContactGraph& graph_;
  std::vector<Mat3> G_;  ///< of J_ (nc)
  UnsymmetricBlockMatrix J_;
  std::vector<char> contact_changes_, block_changes_, pair_changes_;  ///< in the last call
};

/// Matrix times vector (6 nb).
VecX multiply(const BlockPattern& pattern, const UnsymmetricBlockMatrix& matrix, const VecX& x);

}  // namespace cupola
