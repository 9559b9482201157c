#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "solver/contact/blocks/block_matrix.hpp"

namespace cupola {

/// Unsymmetric matrix of 6x6 blocks with a symmetric pattern.
struct UnsymmetricBlockMatrix {
  std::vector<Mat6> diagonal;  ///< (nb)
  std::vector<Mat6> lower;     ///< block (row, column), row > column, of each pair (num_pairs)
  std::vector<Mat6> upper;     ///< block (column, row) of each pair (num_pairs)
};

/// M + sum_i D_i G_i D_i^T for unsymmetric G_i, summed in the order of the contacts.
UnsymmetricBlockMatrix assemble_jacobian(const ContactProblem& problem, const ContactGraph& graph,
                                         const std::vector<Mat3>& G);

/// Matrix times vector (6 nb).
VecX multiply(const BlockPattern& pattern, const UnsymmetricBlockMatrix& matrix, const VecX& x);

/// Sparse LU factor of an UnsymmetricBlockMatrix by UMFPACK, with an ordering for symmetric patterns and a
/// preference for pivots on the diagonal. The ordering and the symbolic analysis are kept while the pattern
/// does not change. Single-threaded, so that the bits do not depend on the number of threads.
///
/// For a plane pattern only the rows x, z and rot y of each block are factorised. The other rows must be
/// those of the identity, as they are in whitened problems.
class BlockLu {
 public:
  /// False if the matrix is singular in double precision or contains NaN; there is then no factor. Throws
  /// std::bad_alloc if memory runs out.
  [[nodiscard]] bool factorize(const BlockPattern& pattern, const UnsymmetricBlockMatrix& matrix);

  bool has_factor() const { return numeric_ != nullptr; }
  const BlockPattern& pattern() const { return pattern_; }  ///< of the last factorisation
  VecX solve(const VecX& rhs) const;                        ///< requires has_factor()

 private:
  struct FreeSymbolic {
    void operator()(void* symbolic) const;
  };
  struct FreeNumeric {
    void operator()(void* numeric) const;
  };
  void analyze(const BlockPattern& pattern);
  void fill(const UnsymmetricBlockMatrix& matrix);

  BlockPattern pattern_;
  int m_ = 6;                                     ///< unknowns per block
  std::vector<std::int64_t> column_start_, row_;  ///< compressed columns
  std::vector<double> value_;
  std::unique_ptr<void, FreeSymbolic> symbolic_;
  std::unique_ptr<void, FreeNumeric> numeric_;
};

}  // namespace cupola
