#pragma once

#include <vector>

#include "solver/contact/methods/primal_cost.hpp"

namespace cupola {

/// Lowers the cost of a whitened problem block by block (nonlinear Gauss-Seidel): each block takes one Newton
/// step of its own, safeguarded along its direction, while the others keep theirs. One pass costs a fraction
/// of a factorisation, and settles contacts that change their region in a few places, which would hold up
/// Newton's step for the whole structure. After the presmoothing of Graeser and Sander (2019), "Truncated
/// nonsmooth Newton multigrid methods for block-separable minimization problems".
class BlockDescent {
 public:
  explicit BlockDescent(const ContactProblem& whitened);

  /// Passes over all blocks in order and back; blocks whose gradient is at most `small` stay. Lowers the
  /// cost.
  PrimalPoint descend(const PrimalPoint& point, double small) const;

 private:
  void move_block(int block, double small, VecX* w, std::vector<Vec3>* y) const;

  const ContactProblem& problem_;
  std::vector<int> start_;     ///< per block its first contact, and the end (nb + 1)
  std::vector<int> contacts_;  ///< in their order
};

}  // namespace cupola
