#include "solver/contact/blocks/panel_factor.hpp"

#include <algorithm>
#include <atomic>

#include <cblas.h>

#include "solver/runtime/interruption.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

namespace {

constexpr int kTileRows = 64;  // blocks
static_assert(kTileRows >= FactorStructure::kPanelWidth, "the first tile contains all own rows");

/// c (rows x columns) = beta c + alpha a b^T
void multiply_transposed(int rows, int columns, int depth, double alpha, const double* a, int ld_a,
                         const double* b, int ld_b, double beta, double* c, int ld_c) {
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, rows, columns, depth, alpha, a, ld_a, b, ld_b, beta, c,
              ld_c);
}

bool consecutive(const int* first, const int* last) {
  return last[-1] - *first == last - first - 1;
}

}  // namespace

std::vector<PanelTile> panel_tiles(int num_rows) {
  std::vector<PanelTile> tiles;
  for (int first = 0; first < num_rows; first += kTileRows)
    tiles.push_back({first, std::min(first + kTileRows, num_rows)});
  return tiles;
}

std::size_t largest_product(const FactorStructure& f, int unknowns) {
  std::size_t largest = 0;
  for (int k = 0; k < f.num_panels(); ++k)
    largest = std::max(largest, std::size_t(std::min(f.num_rows(k), kTileRows)) * f.num_columns(k));
  return largest * unknowns * unknowns;
}

void PanelProducts::subtract(int panel, const PanelTile& tile, std::vector<double>* product) const {
  const int m = unknowns, num_rows = structure.num_rows(panel), ld = m * num_rows;
  const int* rows = structure.rows(panel);
  const auto start = [&](int k) { return std::int64_t{m} * m * structure.value_start[k]; };
  double* to_panel = target + start(panel);
  for (auto k = structure.update_start[panel]; k < structure.update_start[panel + 1]; ++k) {
    const auto [source, first, last] = structure.updates[k];
    const int* source_rows = structure.rows(source);
    const int* end = source_rows + structure.num_rows(source);
    const int* a = std::lower_bound(source_rows + first, end, rows[tile.first]);
    const int* a_end = tile.last == num_rows ? end : std::lower_bound(a, end, rows[tile.last]);
    if (a == a_end) continue;
    const int* b = source_rows + first;
    const int* b_end = above_diagonal ? source_rows + last : std::min(source_rows + last, a_end);
    const int ld_source = m * structure.num_rows(source);
    const int height = m * static_cast<int>(a_end - a), width = m * static_cast<int>(b_end - b);
    const int depth = m * structure.num_columns(source);
    const double* A_q = A + start(source) + m * (a - source_rows);
    const double* B_q = B + start(source) + m * (b - source_rows);
    const int* row = std::lower_bound(rows + tile.first, rows + tile.last, *a);
    const auto column_of = [&](const int* position) -> std::int64_t {
      return std::int64_t{m} * (*position - rows[0]) * ld;
    };
    if (row + (a_end - a) <= rows + tile.last && row[a_end - a - 1] == a_end[-1] && consecutive(b, b_end)) {
      multiply_transposed(height, width, depth, -1.0, A_q, ld_source, B_q, ld_source, 1.0,
                          to_panel + column_of(b) + m * (row - rows), ld);
      continue;
    }
    multiply_transposed(height, width, depth, 1.0, A_q, ld_source, B_q, ld_source, 0.0, product->data(),
                        height);
    for (const double* from = product->data(); a != a_end; ++a, from += m) {
      while (*row != *a) ++row;
      for (const int* column = b; column != b_end; ++column) {
        double* to = to_panel + column_of(column) + m * (row - rows);
        const double* block = from + std::int64_t{m} * (column - b) * height;
        for (int c = 0; c < m; ++c) {
          for (int r = 0; r < m; ++r) to[std::int64_t{c} * ld + r] -= block[c * height + r];
        }
      }
    }
  }
}

bool factorize_panels(const FactorStructure& structure, int unknowns, const PanelSteps& steps) {
  std::atomic<bool> failed = false, abandoned = false;
  run_team(unknowns * unknowns * unknowns * structure.work, [&](Team& team, int thread) {
    team.share(static_cast<int>(structure.subtrees.size()), [&](int i) {
      const FactorStructure::Subtree& tree = structure.subtrees[i];
      for (int panel = tree.first; panel < tree.last && !failed && !abandoned; ++panel) {
        if (must_abandon()) abandoned = true;
        const std::vector<PanelTile> tiles = panel_tiles(structure.num_rows(panel));
        for (const PanelTile& tile : tiles) steps.gather(panel, tile, thread);
        if (!steps.factorize_own_rows(panel)) {
          failed = true;
          continue;
        }
        for (const PanelTile& tile : tiles) steps.divide(panel, tile);
      }
    });
    for (const int panel : structure.top) {
      const std::vector<PanelTile> tiles = panel_tiles(structure.num_rows(panel));
      const int count = static_cast<int>(tiles.size());
      team.share(count, [&](int i) {
        if (!failed && !abandoned) steps.gather(panel, tiles[i], thread);
      });
      team.share(1, [&](int) {
        if (must_abandon()) abandoned = true;
        if (!failed && !abandoned && !steps.factorize_own_rows(panel)) failed = true;
      });
      team.share(count, [&](int i) {
        if (!failed && !abandoned) steps.divide(panel, tiles[i]);
      });
    }
  });
  if (abandoned) throw Interrupted();
  return !failed;
}

}  // namespace cupola
