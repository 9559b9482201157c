#pragma once

#include <cstdint>
#include <vector>

#include "solver/contact/blocks/contact_jacobian.hpp"
#include "solver/contact/blocks/panel_factor.hpp"

namespace cupola {

/// Sparse left-looking factor A = L D U of an UnsymmetricBlockMatrix by panels (factor_structure.hpp). D
/// holds the own rows and columns of the panels; L and U have identities there. With W = D U:
///
///     D_p, L_p, W_p <- A_p - sum over earlier panels q of L_q W_q  (own rows, rows below, columns beside)
///     D_p:  dense LU with row exchanges (LAPACK)
///     L_p <- L_p D_p^-1
///
/// Rows are exchanged within the own rows of a panel only. That is enough for contact problems, whose matrix
/// is the identity plus contact stiffnesses that are unsymmetric only where contacts slide; Newton's method
/// corrects rounding errors.
///
/// The structure is kept while the pattern does not change. Runs on num_threads() threads, with the same bits
/// for any number of them.
///
/// For a plane pattern only the rows x, z and rot y of each block are factorised. The other rows must be
/// those of the identity, as they are in whitened problems.
class BlockLu {
 public:
  /// False if the matrix is singular in double precision or contains NaN; there is then no factor. Throws
  /// std::bad_alloc if memory runs out, and Interrupted.
  [[nodiscard]] bool factorize(const BlockPattern& pattern, const UnsymmetricBlockMatrix& matrix);

  bool has_factor() const { return valid_; }
  const BlockPattern& pattern() const { return pattern_; }  ///< of the last factorisation
  VecX solve(const VecX& rhs) const;                        ///< requires has_factor()

 private:
  std::int64_t start(int panel) const { return std::int64_t{m_} * m_ * structure_.value_start[panel]; }
  void fill(const UnsymmetricBlockMatrix& matrix, int panel, const PanelTile& tile);
  bool factorize_own_rows(int panel);
  void divide(int panel, const PanelTile& tile);

  BlockPattern pattern_;
  FactorStructure structure_;
  int m_ = 6;                                  ///< unknowns per block
  std::vector<double> lower_;                  ///< D_p above L_p of the panels, by columns
  std::vector<double> upper_;                  ///< transpose of W_p; the own rows are unused
  std::vector<int> pivots_;                    ///< of the own rows of the panels (m nb)
  std::vector<std::vector<double>> products_;  ///< work array of each thread
  bool valid_ = false;
};

}  // namespace cupola
