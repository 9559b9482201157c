#pragma once

#include <vector>

#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/blocks/block_rows.hpp"
#include "solver/contact/blocks/rigid_motions.hpp"

namespace cupola {

/// Multigrid preconditioner for Hessians of many blocks, by smoothed aggregation (Vanek, Mandel, Brezina
/// 1996, "Algebraic multigrid by smoothed aggregation for second and fourth order elliptic problems"). On
/// each level, aggregates of about seven blocks become one block of the next level, which keeps their six
/// rigid motions. About a thousand blocks remain on the coarsest level, which is factorised. The smoother is
/// block Gauss-Seidel, forward before the coarse correction and backward after it, so that a cycle is
/// symmetric.
///
/// For a shell, the time and the memory of a factorisation grow with the powers 1.5 and 1.1 of the number of
/// blocks; those of a cycle grow linearly. CG takes 15 to 90 cycles to six digits for 20,000 to 80,000
/// bricks.
///
/// Levels whose matrix is mostly inertia, as in motions with steps of milliseconds, need no coarser ones: the
/// hierarchy ends there with a symmetric sweep.
///
/// Matrices are kept in single precision, in which they remain symmetric, because a cycle is memory-bound.
/// Vectors are in double precision, and so are the products that give the matrix of a coarser level.
///
/// Runs on num_threads() threads, with the same bits for any number: sweeps work on pieces of fixed size.
class Multigrid {
 public:
  /// False if the matrix is not positive definite in double precision, or if aggregation does not coarsen.
  [[nodiscard]] bool build(const BlockPattern& pattern, const BlockMatrix& matrix,
                           const RigidMotions& motions);
  /// The same with the prolongations of the last build() for another matrix of that pattern. They are not
  /// smoothed by this matrix.
  [[nodiscard]] bool rebuild(const BlockPattern& pattern, const BlockMatrix& matrix);

  /// One cycle: an approximation of the inverse times r, symmetric positive definite.
  VecX cycle(const VecX& r) const { return cycle(0, r); }

 private:
  struct Level {
    SingleBlockRows A;
    std::vector<Mat6> inverse;  ///< of the diagonal blocks
    SingleBlockRows P;          ///< prolongation: from motions of the aggregates to those of their members
    SingleBlockRows P_transposed;
  };
  VecX cycle(std::size_t level, const VecX& r) const;
  bool factorize_coarsest(const BlockRows& A);

  std::vector<Level> levels_;
  bool ends_in_sweeps_ = false;  ///< the last level has no coarser one and no factor
  BlockCholesky coarsest_;
};

}  // namespace cupola
