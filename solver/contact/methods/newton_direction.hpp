#pragma once

#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/blocks/multigrid.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Solves H d = rhs for Newton's method: by a fresh Cholesky factor, or by conjugate gradients preconditioned
/// with the factor of an earlier Hessian on the same pattern or with a hierarchy of groups of blocks.
class NewtonDirection {
 public:
  /// Direct solve. False when H is not positive definite in double precision.
  [[nodiscard]] bool solve_directly(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                    VecX* d, SolveSummary* summary);

  /// Conjugate gradients to |H d - rhs| <= forcing |rhs| (in the norm of the preconditioner) with the factor
  /// at hand. False where there is none for this pattern, or they take longer than a factorisation.
  [[nodiscard]] bool solve_lagged(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                  double forcing, VecX* d, SolveSummary* summary) const;

  /// The same with a hierarchy made for H. False where none can be made, or hundreds of gradients do not lead
  /// to a tenth.
  [[nodiscard]] bool solve_by_multigrid(const BlockPattern& pattern, const BlockMatrix& H,
                                        const RigidMotions& motions, const VecX& rhs, double forcing, VecX* d,
                                        SolveSummary* summary);

 private:
  BlockCholesky factor_;
};

}  // namespace cupola
