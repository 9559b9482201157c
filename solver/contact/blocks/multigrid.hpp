#pragma once

#include <vector>

#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/blocks/block_rows.hpp"
#include "solver/contact/blocks/rigid_motions.hpp"

namespace cupola {

/// Preconditioner for the Hessian of very many blocks: multigrid by smoothed aggregation (Vanek, Mandel,
/// Brezina 1996, "Algebraic multigrid by smoothed aggregation for second and fourth order elliptic
/// problems"). Level by level, groups of some seven blocks become one that keeps their six rigid motions,
/// until a thousand are left, which are factorised. Between levels blocks settle one by one (Gauss-Seidel,
/// forth before and back after the coarser level, so that the whole is symmetric).
///
/// Of a shell, time and memory of a factorisation grow with the powers 1.5 and 1.1 of the number of blocks,
/// those of the hierarchy with 1; conjugate gradients take some 15 to 90 cycles to six digits for 20,000 to
/// 80,000 bricks.
///
/// The cycle reads the matrices in single precision, in which they stay symmetric: a cycle is a matter of
/// memory traffic. Vectors, and the matrix that the gradients multiply with, are in double precision.
///
/// Works on num_threads() threads, with the same bits on any number: sweeps go piece by piece of fixed size.
class Multigrid {
 public:
  /// False when the matrix is not positive definite in double precision, or blocks find no groups.
  [[nodiscard]] bool build(const BlockPattern& pattern, const BlockMatrix& matrix,
                           const RigidMotions& motions);

  /// Approximation of the inverse times r; symmetric positive definite.
  VecX cycle(const VecX& r) const { return cycle(0, r); }
  /// The matrix times x.
  VecX multiply(const VecX& x) const;

 private:
  struct Level {
    SingleBlockRows A;
    std::vector<Mat6> inverse;  ///< of the diagonal blocks
    SingleBlockRows P;          ///< from motions of the groups to those of their members
    SingleBlockRows P_transposed;
  };
  VecX cycle(std::size_t level, const VecX& r) const;
  bool factorize_coarsest(const BlockRows& A);

  BlockRows matrix_;
  std::vector<Level> levels_;
  BlockCholesky coarsest_;
};

}  // namespace cupola
