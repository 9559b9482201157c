#pragma once

#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "solver/contact/blocks/panel_factor.hpp"
#include "solver/contact/blocks/single_factor.hpp"

namespace cupola {

/// Leaves new numbers as they are: zeros would be written by one thread, and once more than needed.
template <class T>
struct UninitializedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class Value>
  void construct(U* at, Value&& value) {
    ::new (static_cast<void*>(at)) U(std::forward<Value>(value));
  }
};

/// Sparse left-looking Cholesky factor H = L L^T of a BlockMatrix, by panels (factor_structure.hpp):
///
///     L_p <- H_p - sum over earlier panels q of L_q L_q^T
///     own rows of panel p:      dense Cholesky (LAPACK)
///     rows below its own rows:  multiplied by the inverse transpose of the own rows
///
/// The structure is kept while the pattern does not change. Runs on num_threads() threads, with the same bits
/// for any number of them. (CHOLMOD's own numeric phase leaves the threads to BLAS, whose sums depend on
/// their number.)
///
/// For a plane pattern only the rows x, z and rot y of each block are factorised. The other rows must be
/// those of the identity, as they are in whitened problems.
class BlockCholesky {
 public:
  /// False if the matrix is not positive definite in double precision or contains NaN; there is then no
  /// factor. Throws std::bad_alloc if memory runs out, and Interrupted.
  [[nodiscard]] bool factorize(const BlockPattern& pattern, const BlockMatrix& matrix);

  bool has_factor() const { return valid_; }
  const BlockPattern& pattern() const { return pattern_; }  ///< of the last factorisation
  VecX solve(const VecX& rhs) const;                        ///< requires has_factor()
  /// An approximate solution for preconditioners; requires has_factor(). The first call after a factorisation
  /// copies the factor to single precision, unless it is too ill-conditioned for it.
  VecX solve_approximately(const VecX& rhs);
  long long num_nonzeros() const;  ///< of the factor

 private:
  double* values(int panel) { return values_.data() + m_ * m_ * structure_.value_start[panel]; }
  const double* values(int panel) const { return values_.data() + m_ * m_ * structure_.value_start[panel]; }

  void fill(const BlockMatrix& matrix, int panel, const PanelTile& tile);
  bool factorize_own_rows(int panel);
  void divide(int panel, const PanelTile& tile);

  BlockPattern pattern_;
  FactorStructure structure_;
  int m_ = 6;                                                   ///< unknowns per block
  std::vector<double, UninitializedAllocator<double>> values_;  ///< of the panels, by columns
  std::vector<std::vector<double>> products_;                   ///< work array of each thread
  std::optional<SingleFactor> single_;  ///< copy of the factor; none until it is needed
  bool valid_ = false;
};

}  // namespace cupola
