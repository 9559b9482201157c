#include "solver/contact/blocks/block_cholesky.hpp"

#include <algorithm>
#include <span>

#include <cblas.h>

#include "assembly/base/error.hpp"
#include "solver/contact/blocks/panel_factor.hpp"
#include "solver/contact/blocks/panel_solve.hpp"
#include "solver/runtime/threads.hpp"

extern "C" void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);

namespace cupola {

/// Copies the rows of the tile from the matrix into the panel.
void BlockCholesky::fill(const BlockMatrix& matrix, int panel, const PanelTile& tile) {
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

/// Dense Cholesky factor of the panel's own rows. False if they are not positive definite.
bool BlockCholesky::factorize_own_rows(int panel) {
  const int n = m_ * structure_.num_columns(panel), ld = m_ * structure_.num_rows(panel);
  int info = 0;
  dpotrf_("L", &n, values(panel), &ld, &info);
  return info == 0;
}

/// Multiplies the rows of the tile below the panel's own rows by the inverse transpose of the own rows.
void BlockCholesky::divide(int panel, const PanelTile& tile) {
  const int columns = structure_.num_columns(panel);
  const int first = std::max(tile.first, columns);
  if (first >= tile.last) return;
  const int ld = m_ * structure_.num_rows(panel);
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, m_ * (tile.last - first),
              m_ * columns, 1.0, values(panel), ld, values(panel) + m_ * first, ld);
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
  products_.resize(num_threads(), std::vector<double>(largest_product(structure_, m_)));
  // LAPACK does not detect NaN.
  const auto finite = [](const Mat6& block) { return block.allFinite(); };
  valid_ = false;
  single_.reset();
  if (!std::all_of(matrix.diagonal.begin(), matrix.diagonal.end(), finite) ||
      !std::all_of(matrix.lower.begin(), matrix.lower.end(), finite))
    return false;
  const PanelProducts products{structure_, m_, values_.data(), values_.data(), values_.data(), false};
  PanelSteps steps;
  steps.gather = [&](int panel, const PanelTile& tile, int thread) {
    fill(matrix, panel, tile);
    products.subtract(panel, tile, &products_[thread]);
  };
  steps.factorize_own_rows = [this](int panel) { return factorize_own_rows(panel); };
  steps.divide = [this](int panel, const PanelTile& tile) { divide(panel, tile); };
  valid_ = factorize_panels(structure_, m_, steps);
  return valid_;
}

VecX BlockCholesky::solve(const VecX& rhs) const {
  CUPOLA_ASSERT(valid_ && rhs.size() == 6 * pattern_.num_blocks());
  const auto divide_own_rows = [&](int panel, CBLAS_TRANSPOSE transposed, double* own) {
    const int n = m_ * structure_.num_columns(panel), ld = m_ * structure_.num_rows(panel);
    cblas_dtrsv(CblasColMajor, CblasLower, transposed, CblasNonUnit, n, values(panel), ld, own, 1);
  };
  const auto multiply_rows_below = [&](int panel, CBLAS_TRANSPOSE transposed, const double* by, double beta,
                                       double* result) {
    const int n = m_ * structure_.num_columns(panel), ld = m_ * structure_.num_rows(panel);
    if (ld > n)
      cblas_dgemv(CblasColMajor, transposed, ld - n, n, 1.0, values(panel) + n, ld, by, 1, beta, result, 1);
  };
  return solve_by_panels<double>(
      pattern_, structure_, rhs,
      [&](int panel, const double* own, double* product) {
        const int n = m_ * structure_.num_columns(panel);
        std::copy_n(own, n, product);
        divide_own_rows(panel, CblasNoTrans, product);
        multiply_rows_below(panel, CblasNoTrans, product, 0.0, product + n);
      },
      [&](int panel, const double* product, double* own) {
        const int n = m_ * structure_.num_columns(panel);
        multiply_rows_below(panel, CblasTrans, product + n, 1.0, own);
        divide_own_rows(panel, CblasTrans, own);
      });
}

VecX BlockCholesky::solve_approximately(const VecX& rhs) {
  CUPOLA_ASSERT(valid_ && rhs.size() == 6 * pattern_.num_blocks());
  if (!single_) single_ = SingleFactor(structure_, m_, values_);
  return single_->is_accurate() ? single_->solve(pattern_, structure_, rhs) : solve(rhs);
}

long long BlockCholesky::num_nonzeros() const {
  return static_cast<long long>(values_.size());
}

}  // namespace cupola
