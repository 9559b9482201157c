#pragma once

#include <cstdint>
#include <vector>

#include "solver/contact/blocks/block_matrix.hpp"

namespace cupola {

/// Storage and operations of a sparse Cholesky factor. All sizes count blocks. The position of a block is its
/// place in the order of elimination.
///
/// Columns with (nearly) the same rows form a panel: a dense matrix of its rows by its columns. Its first
/// rows are its own columns.
struct FactorStructure {
  static constexpr int kPanelWidth = 64;  ///< largest number of columns, chosen for the processor's caches

  std::vector<int> position;              ///< of each block (nb)
  std::vector<int> block;                 ///< at each position (nb)
  std::vector<int> first_column;          ///< position of each panel's first column (num_panels + 1)
  std::vector<std::int64_t> row_start;    ///< of each panel in `row` (num_panels + 1)
  std::vector<int> row;                   ///< positions, ascending within a panel
  std::vector<std::int64_t> value_start;  ///< blocks stored before each panel (num_panels + 1)

  /// An off-diagonal block of the matrix: its row in the panel and its pair in the matrix.
  struct Entry {
    int row = 0;  ///< of the panel
    int pair = 0;
    bool transposed = false;
  };
  std::vector<std::int64_t> entry_start;  ///< of each position in `entries` (nb + 1)
  std::vector<Entry> entries;             ///< by rows within a column

  /// Rows first to last - 1 of panel `source` are columns of the updated panel.
  struct Update {
    int source = 0, first = 0, last = 0;
  };
  std::vector<std::int64_t> update_start;  ///< of each panel in `updates` (num_panels + 1)
  std::vector<Update> updates;             ///< by source within a panel

  /// Panels that depend only on each other.
  struct Subtree {
    int first = 0, last = 0;  ///< panels first to last - 1
  };
  std::vector<Subtree> subtrees;  ///< largest first
  double work = 0.0;              ///< block operations of a factorisation
  std::vector<int> top;           ///< the remaining panels, ascending; factorised after the subtrees

  // For substitutions, in which subtrees are independent of each other:
  std::vector<int> target;   ///< as `row`: where contributions of the panel to that row are summed, its
                             ///< position or, from a subtree to the top, nb + index in `top_row`
  std::vector<int> top_row;  ///< positions; each subtree has its own sum for every row of the top it reaches
  int most_rows = 0;         ///< of a panel

  int num_panels() const { return static_cast<int>(first_column.size()) - 1; }
  int num_columns(int panel) const { return first_column[panel + 1] - first_column[panel]; }
  int num_rows(int panel) const { return static_cast<int>(row_start[panel + 1] - row_start[panel]); }
  const int* rows(int panel) const { return row.data() + row_start[panel]; }
};

/// Orders the blocks with METIS and finds the panels (CHOLMOD's analysis), their updates, and subtrees of at
/// most a sixteenth of the work. The last result of each thread is kept, unless it is large: the certificate
/// of a solution has the pattern of its solve. Throws std::bad_alloc if memory runs out.
FactorStructure analyze(const BlockPattern& pattern);

}  // namespace cupola
