#pragma once

#include <optional>

#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/blocks/multigrid.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Solves H d = rhs for Newton's method: by a new Cholesky factor, or by conjugate gradients (CG)
/// preconditioned with the factor of an earlier Hessian of the same pattern, or with multigrid.
class NewtonDirection {
 public:
  /// Direct solve. False if H is not positive definite in double precision.
  [[nodiscard]] bool solve_directly(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                    VecX* d, SolveSummary* summary);

  /// CG to |H d - rhs| <= forcing |rhs| (in the norm of the preconditioner) with the existing factor. False
  /// if there is none for this pattern, or if CG takes longer than a factorisation.
  [[nodiscard]] bool solve_lagged(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                  double forcing, VecX* d, SolveSummary* summary);

  /// The same with a multigrid preconditioner for H. Its prolongations are those of the last call, as long as
  /// they serve. False if it cannot be built, or if hundreds of CG iterations do not reduce the residual to a
  /// tenth.
  [[nodiscard]] bool solve_by_multigrid(const BlockPattern& pattern, const BlockMatrix& H,
                                        const RigidMotions& motions, const VecX& rhs, double forcing, VecX* d,
                                        SolveSummary* summary);
  /// Before another problem.
  void forget_multigrid() { multigrid_.reset(); }

 private:
  BlockCholesky factor_;
  std::optional<Multigrid> multigrid_;
  double per_digit_ = 0.0;  ///< CG iterations per digit with new prolongations
};

}  // namespace cupola
