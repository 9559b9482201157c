#pragma once

#include <vector>

#include "solver/contact/methods/primal_cost.hpp"

namespace cupola {

/// Nonlinear block Gauss-Seidel for the cost of a problem (primal_cost.hpp): each block takes one Newton step
/// with a line search, while the other blocks are fixed. A sweep costs a fraction of a factorisation. It
/// resolves contacts that change their region in a few places, which would otherwise shorten Newton's step for
/// the whole structure. After the presmoothing of Graeser and Sander (2019), "Truncated nonsmooth Newton
/// multigrid methods for block-separable minimization problems".
class BlockDescent {
 public:
  explicit BlockDescent(const WhitenedProblem& problem);

  /// One sweep over all blocks forward and one backward. Skips blocks whose gradient is at most `small`; where
  /// no neighbour has moved, that takes one comparison. The cost of the result is not above that of `point`.
  /// Threads share pieces of the blocks; one thread visits the blocks that touch another piece: the same bits
  /// for any number of threads.
  PrimalPoint descend(const PrimalPoint& point, double small) const;

 private:
  /// What one block sees of its contacts; kept from block to block.
  struct Contacts {
    std::vector<Mat63> columns;
    std::vector<Vec3> y;
  };
  bool move_block(int block, double small, VecX* v, Contacts* contacts) const;

  const WhitenedProblem& white_;
  const ContactProblem& problem_;
  const int piece_;            ///< blocks of a piece
  std::vector<int> start_;     ///< first entry of each block in contacts_, and the end (nb + 1)
  std::vector<int> contacts_;  ///< contacts of each block, ascending
  std::vector<char> border_;   ///< whether a block touches one of another piece (nb)
};

}  // namespace cupola
