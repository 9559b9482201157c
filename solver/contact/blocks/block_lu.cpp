#include "solver/contact/blocks/block_lu.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <cblas.h>

#include "assembly/base/error.hpp"
#include "solver/contact/blocks/panel_solve.hpp"
#include "solver/runtime/threads.hpp"

extern "C" {
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots, int* info);
void dgetrs_(const char* trans, const int* n, const int* nrhs, const double* a, const int* lda,
             const int* pivots, double* b, const int* ldb, int* info);
}

namespace cupola {

/// Copies the rows of the tile from the matrix into both factors.
void BlockLu::fill(const UnsymmetricBlockMatrix& matrix, int panel, const PanelTile& tile) {
  const std::span<const int> unknowns = unknowns_of_block(pattern_);
  const int first_column = structure_.first_column[panel], columns = structure_.num_columns(panel);
  const std::int64_t ld = std::int64_t{m_} * structure_.num_rows(panel);
  for (std::vector<double>* values : {&lower_, &upper_}) {
    double* panel_values = values->data() + start(panel);
    for (int c = 0; c < m_ * columns; ++c)
      std::fill(panel_values + c * ld + m_ * tile.first, panel_values + c * ld + m_ * tile.last, 0.0);
  }
  const auto put = [&](std::vector<double>* values, int row, int column, const auto& block) {
    for (int c = 0; c < m_; ++c) {
      double* to = values->data() + start(panel) + (m_ * column + c) * ld + m_ * row;
      for (int r = 0; r < m_; ++r) to[r] = block(unknowns[r], unknowns[c]);
    }
  };
  for (int column = 0; column < columns; ++column) {
    const int position = first_column + column;
    if (tile.first <= column && column < tile.last)
      put(&lower_, column, column, matrix.diagonal[structure_.block[position]]);
    for (auto k = structure_.entry_start[position]; k < structure_.entry_start[position + 1]; ++k) {
      const auto& [row, pair, transposed] = structure_.entries[k];
      if (row < tile.first || row >= tile.last) continue;
      put(&lower_, row, column, transposed ? matrix.upper[pair] : matrix.lower[pair]);
      const Mat6& above = transposed ? matrix.lower[pair] : matrix.upper[pair];
      if (row < columns)
        put(&lower_, column, row, above);
      else
        put(&upper_, row, column, above.transpose());
    }
  }
}

/// Dense LU factor of the panel's own rows. False if they are singular.
bool BlockLu::factorize_own_rows(int panel) {
  const int n = m_ * structure_.num_columns(panel), ld = m_ * structure_.num_rows(panel);
  int info = 0;
  dgetrf_(&n, &n, lower_.data() + start(panel), &ld, pivots_.data() + m_ * structure_.first_column[panel],
          &info);
  return info == 0;
}

/// Multiplies the rows of the tile below the panel's own rows by the inverse of the own rows: with S D = T R,
/// the row exchanges S and the triangles T and R, X D = B has the solution X = B R^-1 T^-1 S.
void BlockLu::divide(int panel, const PanelTile& tile) {
  const int columns = structure_.num_columns(panel);
  const int first = std::max(tile.first, columns);
  if (first >= tile.last) return;
  const int n = m_ * columns, ld = m_ * structure_.num_rows(panel), height = m_ * (tile.last - first);
  const double* D = lower_.data() + start(panel);
  double* B = lower_.data() + start(panel) + m_ * first;
  cblas_dtrsm(CblasColMajor, CblasRight, CblasUpper, CblasNoTrans, CblasNonUnit, height, n, 1.0, D, ld, B,
              ld);
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasUnit, height, n, 1.0, D, ld, B, ld);
  const int* pivots = pivots_.data() + m_ * structure_.first_column[panel];
  for (int k = n - 1; k >= 0; --k) {
    const int other = pivots[k] - 1;  // LAPACK counts from 1
    if (other != k) cblas_dswap(height, B + std::int64_t{k} * ld, 1, B + std::int64_t{other} * ld, 1);
  }
}

bool BlockLu::factorize(const BlockPattern& pattern, const UnsymmetricBlockMatrix& matrix) {
  CUPOLA_ASSERT(std::ssize(matrix.diagonal) == pattern.num_blocks());
  CUPOLA_ASSERT(std::ssize(matrix.lower) == pattern.num_pairs());
  CUPOLA_ASSERT(std::ssize(matrix.upper) == pattern.num_pairs());
  openblas_set_num_threads(1);
  valid_ = false;
  if (pattern_ != pattern || lower_.empty()) {
    lower_ = upper_ = {};
    structure_ = analyze(pattern);
    pattern_ = pattern;
    m_ = static_cast<int>(unknowns_of_block(pattern).size());
    lower_.resize(start(structure_.num_panels()));
    upper_.resize(lower_.size());
    pivots_.resize(m_ * pattern.num_blocks());
    products_ = {};
  }
  products_.resize(num_threads(), std::vector<double>(largest_product(structure_, m_)));
  // LAPACK does not detect NaN.
  const auto finite = [](const std::vector<Mat6>& blocks) {
    return std::all_of(blocks.begin(), blocks.end(), [](const Mat6& block) { return block.allFinite(); });
  };
  if (!finite(matrix.diagonal) || !finite(matrix.lower) || !finite(matrix.upper)) return false;
  const PanelProducts to_lower{structure_, m_, lower_.data(), upper_.data(), lower_.data(), true};
  const PanelProducts to_upper{structure_, m_, upper_.data(), lower_.data(), upper_.data(), false};
  PanelSteps steps;
  steps.gather = [&](int panel, const PanelTile& tile, int thread) {
    fill(matrix, panel, tile);
    to_lower.subtract(panel, tile, &products_[thread]);
    const PanelTile below{std::max(tile.first, structure_.num_columns(panel)), tile.last};
    if (below.first < below.last) to_upper.subtract(panel, below, &products_[thread]);
  };
  steps.factorize_own_rows = [this](int panel) { return factorize_own_rows(panel); };
  steps.divide = [this](int panel, const PanelTile& tile) { divide(panel, tile); };
  valid_ = factorize_panels(structure_, m_, steps);
  return valid_;
}

VecX BlockLu::solve(const VecX& rhs) const {
  CUPOLA_ASSERT(valid_ && rhs.size() == 6 * pattern_.num_blocks());
  const auto multiply_rows_below = [&](const std::vector<double>& values, int panel,
                                       CBLAS_TRANSPOSE transposed, const double* by, double beta,
                                       double* result) {
    const int n = m_ * structure_.num_columns(panel), ld = m_ * structure_.num_rows(panel);
    if (ld > n)
      cblas_dgemv(CblasColMajor, transposed, ld - n, n, 1.0, values.data() + start(panel) + n, ld, by, 1,
                  beta, result, 1);
  };
  return solve_by_panels<double>(
      pattern_, structure_, rhs,
      [&](int panel, const double* own, double* product) {
        const int n = m_ * structure_.num_columns(panel);
        std::copy_n(own, n, product);
        multiply_rows_below(lower_, panel, CblasNoTrans, own, 0.0, product + n);
      },
      [&](int panel, const double* product, double* own) {
        const int n = m_ * structure_.num_columns(panel), ld = m_ * structure_.num_rows(panel), one = 1;
        multiply_rows_below(upper_, panel, CblasTrans, product + n, 1.0, own);
        int info = 0;
        dgetrs_("N", &n, &one, lower_.data() + start(panel), &ld,
                pivots_.data() + m_ * structure_.first_column[panel], own, &n, &info);
      });
}

}  // namespace cupola
