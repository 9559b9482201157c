#pragma once

#include <span>
#include <vector>

#include "solver/contact/blocks/factor_structure.hpp"

namespace cupola {

/// Copy of a Cholesky factor in single precision, for preconditioners. The own rows T of a panel are
/// inverted, and the rows B below them multiplied by that inverse:
///
///     L y = b:      y = T^-1 b,            b below <- b below - (B T^-1) b
///     L^T x = y:    x = T^-T y - (B T^-1)^T x below
///
/// so that each panel is one product with a matrix, of half the bytes, per direction.
class SingleFactor {
 public:
  /// `values`: of the panels of the factor of I + D G D^T, masses scaled to one, with `unknowns` per block.
  SingleFactor(const FactorStructure& structure, int unknowns, std::span<const double> values);

  /// False if rounding to single precision may change the solution by more than a few percent.
  bool is_accurate() const { return accurate_; }
  /// The solution of L L^T x = rhs. Requires is_accurate().
  VecX solve(const BlockPattern& pattern, const FactorStructure& structure, const VecX& rhs) const;

 private:
  std::vector<float> values_;  ///< T^-1 and B T^-1 of the panels, by columns
  bool accurate_ = true;
};

}  // namespace cupola
