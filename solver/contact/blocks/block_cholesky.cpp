#include "solver/contact/blocks/block_cholesky.hpp"

#include <algorithm>
#include <atomic>
#include <span>

#include <cblas.h>

#include "assembly/base/error.hpp"
#include "solver/runtime/interruption.hpp"
#include "solver/runtime/threads.hpp"

extern "C" void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);

namespace cupola {

namespace {

constexpr int kTileRows = 64;  // blocks

/// c (rows x columns) = beta c + alpha a b^T
void multiply_transposed(int rows, int columns, int depth, double alpha, const double* a, int ld_a,
                         const double* b, int ld_b, double beta, double* c, int ld_c) {
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, rows, columns, depth, alpha, a, ld_a, b, ld_b, beta, c,
              ld_c);
}

/// Size in blocks of the largest product of a tile with the columns of a panel.
std::size_t largest_product(const FactorStructure& f) {
  std::size_t largest = 0;
  for (int k = 0; k < f.num_panels(); ++k)
    largest = std::max(largest, std::size_t(std::min(f.num_rows(k), kTileRows)) * f.num_columns(k));
  return largest;
}

bool consecutive(const int* first, const int* last) {
  return last[-1] - *first == last - first - 1;
}

}  // namespace

std::vector<BlockCholesky::Tile> BlockCholesky::tiles(int num_rows) {
  std::vector<Tile> tiles;
  for (int first = 0; first < num_rows; first += kTileRows)
    tiles.push_back({first, std::min(first + kTileRows, num_rows)});
  return tiles;
}

/// Copies the rows of the tile from the matrix into the panel.
void BlockCholesky::fill(const BlockMatrix& matrix, int panel, const Tile& tile) {
  const std::span<const int> unknowns = unknowns_of_block(pattern_);
  const int first_column = structure_.first_column[panel], columns = structure_.num_columns(panel);
  const std::int64_t ld = std::int64_t{m_} * structure_.num_rows(panel);
  double* L = values(panel);
  for (int c = 0; c < m_ * columns; ++c)
    std::fill(L + c * ld + m_ * tile.first, L + c * ld + m_ * tile.last, 0.0);
  const auto put = [&](int row, int column, const auto& block) {
    for (int c = 0; c < m_; ++c) {
      double* to = L + (m_ * column + c) * ld + m_ * row;
      for (int r = 0; r < m_; ++r) to[r] = block(unknowns[r], unknowns[c]);
    }
  };
  for (int column = 0; column < columns; ++column) {
    const int position = first_column + column;
    if (tile.first <= column && column < tile.last)
      put(column, column, matrix.diagonal[structure_.block[position]]);
    for (auto k = structure_.entry_start[position]; k < structure_.entry_start[position + 1]; ++k) {
      const FactorStructure::Entry& entry = structure_.entries[k];
      if (entry.row < tile.first || entry.row >= tile.last) continue;
      if (entry.transposed)
        put(entry.row, column, matrix.lower[entry.pair].transpose());
      else
        put(entry.row, column, matrix.lower[entry.pair]);
    }
  }
}

/// Subtracts the products of the earlier panels from the rows of the tile.
void BlockCholesky::update(int panel, const Tile& tile, std::vector<double>* product) {
  const int* rows = structure_.rows(panel);
  const int num_rows = structure_.num_rows(panel);
  const int ld = m_ * num_rows;
  double* L = values(panel);
  for (auto k = structure_.update_start[panel]; k < structure_.update_start[panel + 1]; ++k) {
    const auto [source, first, last] = structure_.updates[k];
    const int* source_rows = structure_.rows(source);
    const int* end = source_rows + structure_.num_rows(source);
    const int* a = std::lower_bound(source_rows + first, end, rows[tile.first]);
    const int* a_end = tile.last == num_rows ? end : std::lower_bound(a, end, rows[tile.last]);
    if (a == a_end) continue;
    const int* b = source_rows + first;
    const int* b_end = std::min(source_rows + last, a_end);  // nothing above the diagonal
    const int ld_source = m_ * structure_.num_rows(source);
    const int height = m_ * static_cast<int>(a_end - a), width = m_ * static_cast<int>(b_end - b);
    const int depth = m_ * structure_.num_columns(source);
    const double* A = values(source) + m_ * (a - source_rows);
    const double* B = values(source) + m_ * (b - source_rows);
    const int* row = std::lower_bound(rows + tile.first, rows + tile.last, *a);
    const auto column_of = [&](const int* position) -> std::int64_t {
      return std::int64_t{m_} * (*position - rows[0]) * ld;
    };
    if (row + (a_end - a) <= rows + tile.last && row[a_end - a - 1] == a_end[-1] && consecutive(b, b_end)) {
      multiply_transposed(height, width, depth, -1.0, A, ld_source, B, ld_source, 1.0,
                          L + column_of(b) + m_ * (row - rows), ld);
      continue;
    }
    multiply_transposed(height, width, depth, 1.0, A, ld_source, B, ld_source, 0.0, product->data(), height);
    for (const double* from = product->data(); a != a_end; ++a, from += m_) {
      while (*row != *a) ++row;
      for (const int* column = b; column != b_end; ++column) {
        double* to = L + column_of(column) + m_ * (row - rows);
        const double* block = from + std::int64_t{m_} * (column - b) * height;
        for (int c = 0; c < m_; ++c) {
          for (int r = 0; r < m_; ++r) to[c * ld + r] -= block[c * height + r];
        }
      }
    }
  }
}

/// Dense Cholesky factor of the panel's own rows. False if they are not positive definite.
bool BlockCholesky::factorize_own_rows(int panel) {
  const int n = m_ * structure_.num_columns(panel), ld = m_ * structure_.num_rows(panel);
  int info = 0;
  dpotrf_("L", &n, values(panel), &ld, &info);
  return info == 0;
}

/// Multiplies the rows of the tile below the panel's own rows by the inverse transpose of the own rows.
void BlockCholesky::divide(int panel, const Tile& tile) {
  const int columns = structure_.num_columns(panel);
  const int first = std::max(tile.first, columns);
  if (first >= tile.last) return;
  const int ld = m_ * structure_.num_rows(panel);
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, m_ * (tile.last - first),
              m_ * columns, 1.0, values(panel), ld, values(panel) + m_ * first, ld);
}

bool BlockCholesky::factorize_panel(const BlockMatrix& matrix, int panel, std::vector<double>* product) {
  for (const Tile& tile : tiles(structure_.num_rows(panel))) {
    fill(matrix, panel, tile);
    update(panel, tile, product);
  }
  if (!factorize_own_rows(panel)) return false;
  for (const Tile& tile : tiles(structure_.num_rows(panel))) divide(panel, tile);
  return true;
}

bool BlockCholesky::factorize(const BlockPattern& pattern, const BlockMatrix& matrix) {
  CUPOLA_ASSERT(std::ssize(matrix.diagonal) == pattern.num_blocks());
  CUPOLA_ASSERT(std::ssize(matrix.lower) == pattern.num_pairs());
  openblas_set_num_threads(1);
  if (pattern_ != pattern || values_.empty()) {
    values_ = {};
    structure_ = analyze(pattern);
    pattern_ = pattern;
    m_ = static_cast<int>(unknowns_of_block(pattern).size());
    values_.resize(m_ * m_ * structure_.value_start.back());
    products_ = {};
  }
  products_.resize(num_threads(), std::vector<double>(m_ * m_ * largest_product(structure_)));
  // LAPACK does not detect NaN.
  const auto finite = [](const Mat6& block) { return block.allFinite(); };
  std::atomic<bool> positive_definite = std::all_of(matrix.diagonal.begin(), matrix.diagonal.end(), finite) &&
                                        std::all_of(matrix.lower.begin(), matrix.lower.end(), finite);
  std::atomic<bool> abandoned = false;
  if (positive_definite) {
    run_team(m_ * m_ * m_ * structure_.work, [&](Team& team, int thread) {
      std::vector<double>* product = &products_[thread];
      team.share(static_cast<int>(structure_.subtrees.size()), [&](int i) {
        const FactorStructure::Subtree& tree = structure_.subtrees[i];
        for (int panel = tree.first; panel < tree.last && positive_definite && !abandoned; ++panel) {
          if (must_abandon()) abandoned = true;

          if (!factorize_panel(matrix, panel, product)) positive_definite = false;
        }
      });
      for (const int panel : structure_.top) {
        const std::vector<Tile> rows = tiles(structure_.num_rows(panel));
        const int count = static_cast<int>(rows.size());
        team.share(count, [&](int i) {
          if (abandoned) return;
          fill(matrix, panel, rows[i]);
          update(panel, rows[i], product);
        });
        team.share(1, [&](int) {
          if (must_abandon()) abandoned = true;
          if (!abandoned && !factorize_own_rows(panel)) positive_definite = false;
        });
        team.share(count, [&](int i) {
          if (!abandoned) divide(panel, rows[i]);
        });
      }
    });
  }
  valid_ = positive_definite && !abandoned;
  if (abandoned) throw Interrupted();
  return valid_;
}

VecX BlockCholesky::solve(const VecX& rhs) const {
  CUPOLA_ASSERT(valid_ && rhs.size() == 6 * pattern_.num_blocks());
  const std::span<const int> unknowns = unknowns_of_block(pattern_);
  const int nb = pattern_.num_blocks();
  VecX x(m_ * nb), below(m_ * nb);
  for (int k = 0; k < nb; ++k) {
    for (int r = 0; r < m_; ++r) x[m_ * structure_.position[k] + r] = rhs[6 * k + unknowns[r]];
  }
  const int num_panels = structure_.num_panels();
  for (int panel = 0; panel < num_panels; ++panel) {  // L y = rhs
    const int columns = structure_.num_columns(panel), rest = structure_.num_rows(panel) - columns;
    const int n = m_ * columns, ld = m_ * (columns + rest);
    double* own = x.data() + m_ * structure_.first_column[panel];
    const double* L = values(panel);
    cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, n, L, ld, own, 1);
    if (rest == 0) continue;
    cblas_dgemv(CblasColMajor, CblasNoTrans, m_ * rest, n, 1.0, L + n, ld, own, 1, 0.0, below.data(), 1);
    const int* rows = structure_.rows(panel) + columns;
    for (int i = 0; i < rest; ++i) {
      for (int r = 0; r < m_; ++r) x[m_ * rows[i] + r] -= below[m_ * i + r];
    }
  }
  for (int panel = num_panels - 1; panel >= 0; --panel) {  // L^T x = y
    const int columns = structure_.num_columns(panel), rest = structure_.num_rows(panel) - columns;
    const int n = m_ * columns, ld = m_ * (columns + rest);
    double* own = x.data() + m_ * structure_.first_column[panel];
    const double* L = values(panel);
    const int* rows = structure_.rows(panel) + columns;
    for (int i = 0; i < rest; ++i) {
      for (int r = 0; r < m_; ++r) below[m_ * i + r] = x[m_ * rows[i] + r];
    }
    if (rest > 0)
      cblas_dgemv(CblasColMajor, CblasTrans, m_ * rest, n, -1.0, L + n, ld, below.data(), 1, 1.0, own, 1);
    cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, n, L, ld, own, 1);
  }
  VecX solution = rhs;  // rows that are no unknowns are those of the identity
  for (int k = 0; k < nb; ++k) {
    for (int r = 0; r < m_; ++r) solution[6 * k + unknowns[r]] = x[m_ * structure_.position[k] + r];
  }
  return solution;
}

long long BlockCholesky::num_nonzeros() const {
  return static_cast<long long>(values_.size());
}

}  // namespace cupola
