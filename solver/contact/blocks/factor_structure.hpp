#pragma once

#include <cstdint>
#include <vector>

#include "solver/contact/blocks/block_matrix.hpp"

namespace cupola {

/// Where the blocks of a Cholesky factor lie, and what has to be done to compute them. Everything counts in
/// blocks, and a block's place in the order of elimination is its position.
///
/// Columns of (nearly) the same rows form panels. A panel is a dense matrix of its rows by its columns; its
/// own columns are its first rows.
struct FactorStructure {
  static constexpr int kPanelWidth = 64;  ///< columns at most, for the sake of the processor's caches

  std::vector<int> position;              ///< of each block (nb)
  std::vector<int> block;                 ///< at each position (nb)
  std::vector<int> first_column;          ///< position of each panel's first column (num_panels + 1)
  std::vector<std::int64_t> row_start;    ///< of each panel in `row` (num_panels + 1)
  std::vector<int> row;                   ///< positions, ascending within a panel
  std::vector<std::int64_t> value_start;  ///< blocks stored before each panel (num_panels + 1)

  /// A block of the matrix, off its diagonal: where it goes in its panel and where it comes from.
  struct Entry {
    int row = 0;  ///< of the panel
    int pair = 0;
    bool transposed = false;
  };
  std::vector<std::int64_t> entry_start;  ///< of each position in `entries` (nb + 1)
  std::vector<Entry> entries;             ///< by rows within a column

  /// Rows first to last - 1 of panel `source` are columns of the panel that it updates.
  struct Update {
    int source = 0, first = 0, last = 0;
  };
  std::vector<std::int64_t> update_start;  ///< of each panel in `updates` (num_panels + 1)
  std::vector<Update> updates;             ///< by source within a panel

  /// Panels that need no others but each other.
  struct Subtree {
    int first = 0, last = 0;  ///< panels first to last - 1
  };
  std::vector<Subtree> subtrees;  ///< the greatest first
  double work = 0.0;              ///< multiplications and additions of blocks in a factorisation
  std::vector<int> top;           ///< the other panels, ascending: they follow the subtrees

  int num_panels() const { return static_cast<int>(first_column.size()) - 1; }
  int num_columns(int panel) const { return first_column[panel + 1] - first_column[panel]; }
  int num_rows(int panel) const { return static_cast<int>(row_start[panel + 1] - row_start[panel]); }
  const int* rows(int panel) const { return row.data() + row_start[panel]; }
};

/// METIS's order of the blocks, the panels that it leads to (CHOLMOD's analysis), their updates, and subtrees
/// of at most a sixteenth of the work. Throws std::bad_alloc when memory runs out.
FactorStructure analyze(const BlockPattern& pattern);

}  // namespace cupola
