#pragma once

#include <memory>

#include "solver/contact/block_matrix.hpp"

namespace cupola {

/// Sparse Cholesky factor of a BlockMatrix (CHOLMOD, supernodal). The fill-reducing order is METIS's on the
/// graph of the blocks, expanded to their six rows each; it and the symbolic factor are kept while the
/// pattern stays the same. BLAS is set to one thread: same bits on every run.
///
/// Of a plane pattern the rows x, z and rot y of each block are factorised alone: the others must be those of
/// the identity, as they are in whitened problems.
class BlockCholesky {
 public:
  BlockCholesky();
  ~BlockCholesky();
  BlockCholesky(BlockCholesky&&) noexcept;
  BlockCholesky& operator=(BlockCholesky&&) noexcept;

  /// False when the matrix is not positive definite in double precision or holds NaN; the factor is then
  /// void. Throws std::bad_alloc when memory runs out.
  [[nodiscard]] bool factorize(const BlockPattern& pattern, const BlockMatrix& matrix);

  bool has_factor() const;
  const BlockPattern& pattern() const;  ///< of the last factorisation
  VecX solve(const VecX& rhs) const;    ///< needs has_factor()
  long long num_nonzeros() const;       ///< of the factor

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace cupola
