#pragma once

#include <functional>
#include <vector>

#include "solver/contact/blocks/factor_structure.hpp"

namespace cupola {

/// Rows first to last - 1 of a panel. The first tile of a panel contains all its own rows.
struct PanelTile {
  int first = 0, last = 0;
};
std::vector<PanelTile> panel_tiles(int num_rows);

/// Subtracts from the rows of a tile the products A_q B_q^T of the earlier panels q, where A and B are
/// factors with the structure and `unknowns` per block, and `target` is the factor to which the tile belongs.
struct PanelProducts {
  const FactorStructure& structure;
  int unknowns;
  const double* A;
  const double* B;
  double* target;
  bool above_diagonal;  ///< also above the diagonal of the panel's own rows

  /// `product`: at least largest_product() numbers.
  void subtract(int panel, const PanelTile& tile, std::vector<double>* product) const;
};

/// Size of the largest product of a tile with the columns of a panel.
std::size_t largest_product(const FactorStructure& structure, int unknowns);

/// What a sparse factorisation by panels does with each of them.
struct PanelSteps {
  /// Copies the rows of a tile from the matrix and subtracts the products of the earlier panels.
  std::function<void(int panel, const PanelTile& tile, int thread)> gather;
  std::function<bool(int panel)> factorize_own_rows;  ///< false: the factorisation fails
  std::function<void(int panel, const PanelTile& tile)> divide;
};

/// Factorises all panels on num_threads() threads: first by subtrees, then panel by panel by tiles of rows.
/// The result has the same bits for any number of threads: BLAS itself is single-threaded, the tiles do not
/// depend on the number of threads, and sums follow the order of the panels. False if a step failed. Throws
/// Interrupted.
[[nodiscard]] bool factorize_panels(const FactorStructure& structure, int unknowns, const PanelSteps& steps);

}  // namespace cupola
