#pragma once

#include <vector>

#include "solver/contact/methods/primal_cost.hpp"

namespace cupola {

/// Nonlinear block Gauss-Seidel for the cost of a whitened problem: each block takes one Newton step with a
/// line search, while the other blocks are fixed. A sweep costs a fraction of a factorisation. It resolves
/// contacts that change their region in a few places, which would otherwise shorten Newton's step for the
/// whole structure. After the presmoothing of Graeser and Sander (2019), "Truncated nonsmooth Newton
/// multigrid methods for block-separable minimization problems".
class BlockDescent {
 public:
  explicit BlockDescent(const ContactProblem& whitened);

  /// One sweep over all blocks forward and one backward. Skips blocks whose gradient is at most `small`; where
  /// no neighbour has moved, that takes one comparison. The cost of the result is not above that of `point`.
  /// Threads share pieces of the blocks; one thread visits the blocks that touch another piece: the same bits
  /// for any number of threads.
  PrimalPoint descend(const PrimalPoint& point, double small) const;

 private:
  bool move_block(int block, double small, VecX* w, std::vector<Vec3>* y) const;

  const ContactProblem& problem_;
  std::vector<int> start_;     ///< first entry of each block in contacts_, and the end (nb + 1)
  std::vector<int> contacts_;  ///< contacts of each block, ascending
  std::vector<char> border_;   ///< whether a block touches one of another piece (nb)
};

}  // namespace cupola
