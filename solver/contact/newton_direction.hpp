#pragma once

#include "solver/contact/block_cholesky.hpp"
#include "solver/contact/solve_summary.hpp"

namespace cupola {

/// Solves H d = rhs for Newton's method, by a fresh Cholesky factor or by conjugate gradients preconditioned
/// with the factor of an earlier Hessian on the same pattern.
class NewtonDirection {
 public:
  static constexpr int kMaxConjugateGradients = 25;  ///< about the cost of a factorisation at 1,000 blocks

  /// Direct solve. False when H is not positive definite in double precision.
  [[nodiscard]] bool solve_directly(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                    VecX* d, SolveSummary* summary);

  /// Conjugate gradients that cost less than a factorisation of the last pattern; 0: too few to try.
  int affordable_gradients() const;

  /// Conjugate gradients to |H d - rhs| <= forcing |rhs| (in the norm of the inverse preconditioner) with the
  /// factor at hand. False where there is none for this pattern, or they need more than max_gradients.
  [[nodiscard]] bool solve_lagged(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                  double forcing, int max_gradients, VecX* d, SolveSummary* summary) const;

 private:
  BlockCholesky factor_;
};

}  // namespace cupola
