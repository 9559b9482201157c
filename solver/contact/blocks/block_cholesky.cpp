#include "solver/contact/blocks/block_cholesky.hpp"

#include <algorithm>
#include <span>

#include <cblas.h>

#include "assembly/base/error.hpp"
#include "solver/contact/blocks/panel_factor.hpp"
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
  VecX x = in_order_of_elimination<double>(rhs), below(x.size());
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
  return in_order_of_blocks(x, rhs);
}

template <class Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, 1> BlockCholesky::in_order_of_elimination(const VecX& rhs) const {
  const std::span<const int> unknowns = unknowns_of_block(pattern_);
  Eigen::Matrix<Scalar, Eigen::Dynamic, 1> x(m_ * pattern_.num_blocks());
  for (int k = 0; k < pattern_.num_blocks(); ++k) {
    for (int r = 0; r < m_; ++r)
      x[m_ * structure_.position[k] + r] = static_cast<Scalar>(rhs[6 * k + unknowns[r]]);
  }
  return x;
}

template <class Scalar>
VecX BlockCholesky::in_order_of_blocks(const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& x,
                                       const VecX& rhs) const {
  const std::span<const int> unknowns = unknowns_of_block(pattern_);
  VecX solution = rhs;  // rows that are no unknowns are those of the identity
  for (int k = 0; k < pattern_.num_blocks(); ++k) {
    for (int r = 0; r < m_; ++r) solution[6 * k + unknowns[r]] = x[m_ * structure_.position[k] + r];
  }
  return solution;
}

VecX BlockCholesky::solve_approximately(const VecX& rhs) {
  CUPOLA_ASSERT(valid_ && rhs.size() == 6 * pattern_.num_blocks());
  if (!single_) single_ = SingleFactor(structure_, m_, values_);
  if (!single_->is_accurate()) return solve(rhs);
  Eigen::VectorXf x = in_order_of_elimination<float>(rhs);
  single_->solve(structure_, m_, &x);
  return in_order_of_blocks(x, rhs);
}

long long BlockCholesky::num_nonzeros() const {
  return static_cast<long long>(values_.size());
}

}  // namespace cupola
