#include "solver/contact/blocks/block_lu.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include <cblas.h>

#include "assembly/base/error.hpp"
#include "solver/runtime/threads.hpp"

extern "C" {
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots, int* info);
void dgetrs_(const char* trans, const int* n, const int* nrhs, const double* a, const int* lda,
             const int* pivots, double* b, const int* ldb, int* info);
}

namespace cupola {

ContactJacobian::ContactJacobian(const WhitenedProblem& problem, const ContactGraph& graph)
    : white_(problem),
      problem_(problem.given),
      graph_(graph),
      G_(problem_.num_contacts(), Mat3::Zero()),
      J_{std::vector<Mat6>(problem_.num_blocks(), Mat6::Identity()),
         std::vector<Mat6>(graph.pattern.num_pairs(), Mat6::Zero()),
         {}} {
  J_.upper = J_.lower;
}

/// Marks the 6x6 blocks that change, sets them to zero, and keeps G.
void ContactJacobian::mark_changed(const std::vector<Mat3>& G) {
  block_changes_.assign(problem_.num_blocks(), 0);
  pair_changes_.assign(graph_.pattern.num_pairs(), 0);
  for (int i = 0; i < problem_.num_contacts(); ++i) {
    if (std::memcmp(G[i].data(), G_[i].data(), sizeof(Mat3)) == 0) continue;
    G_[i] = G[i];
    for (const int block : {problem_.block_a[i], problem_.block_b[i]}) {
      if (block == ContactProblem::kFixed) continue;
      block_changes_[block] = 1;
      J_.diagonal[block].setZero();
    }
    const int pair = graph_.pair_of_contact[i];
    if (pair < 0) continue;
    pair_changes_[pair] = 1;
    J_.lower[pair].setZero();
    J_.upper[pair].setZero();
  }
}

void ContactJacobian::sum_marked() {
  const auto changes = [&](int block) {
    return block != ContactProblem::kFixed && block_changes_[block] != 0;
  };
  for (int i = 0; i < problem_.num_contacts(); ++i) {
    const int a = problem_.block_a[i], b = problem_.block_b[i], pair = graph_.pair_of_contact[i];
    if (!changes(a) && !changes(b)) continue;  // nor does the pair
    if (G_[i].isZero(0.0)) continue;
    Mat63 D_a, D_b, D_a_G, D_b_G;
    if (changes(a)) {
      D_a = contact_columns(problem_, i, a);
      D_a_G = D_a.lazyProduct(G_[i]);
      J_.diagonal[a] += D_a_G.lazyProduct(D_a.transpose());
    }
    if (changes(b) && b != a) {
      D_b = contact_columns(problem_, i, b);
      D_b_G = D_b.lazyProduct(G_[i]);
      J_.diagonal[b] += D_b_G.lazyProduct(D_b.transpose());
    }
    if (pair < 0 || pair_changes_[pair] == 0) continue;  // both blocks change with it
    (a < b ? J_.upper : J_.lower)[pair] += D_a_G.lazyProduct(D_b.transpose());
    (a < b ? J_.lower : J_.upper)[pair] += D_b_G.lazyProduct(D_a.transpose());
  }
}

void ContactJacobian::whiten_marked() {
  const auto whiten = [&](int row, int column, Mat6* block) {
    *block = (white_.L_inverse[row] * *block * white_.L_inverse[column].transpose()).eval();
  };
  const BlockPattern& pattern = graph_.pattern;
  for (int column = 0; column < pattern.num_blocks(); ++column) {
    if (block_changes_[column] == 0) continue;
    whiten(column, column, &J_.diagonal[column]);
    J_.diagonal[column].diagonal().array() += 1.0;
    for (int pair = pattern.column_start[column]; pair < pattern.column_start[column + 1]; ++pair) {
      if (pair_changes_[pair] == 0) continue;
      whiten(pattern.row[pair], column, &J_.lower[pair]);
      whiten(column, pattern.row[pair], &J_.upper[pair]);
    }
  }
}

const UnsymmetricBlockMatrix& ContactJacobian::at(const std::vector<Mat3>& G) {
  CUPOLA_ASSERT(std::ssize(G) == problem_.num_contacts());
  mark_changed(G);
  sum_marked();
  whiten_marked();
  return J_;
}

VecX multiply(const BlockPattern& pattern, const UnsymmetricBlockMatrix& matrix, const VecX& x) {
  CUPOLA_ASSERT(x.size() == 6 * pattern.num_blocks());
  VecX y(x.size());
  for (int k = 0; k < pattern.num_blocks(); ++k)
    y.segment<6>(6 * k).noalias() = matrix.diagonal[k] * x.segment<6>(6 * k);
  for (int k = 0; k < pattern.num_blocks(); ++k) {
    for (int pair = pattern.column_start[k]; pair < pattern.column_start[k + 1]; ++pair) {
      const int row = pattern.row[pair];
      y.segment<6>(6 * row).noalias() += matrix.lower[pair] * x.segment<6>(6 * k);
      y.segment<6>(6 * k).noalias() += matrix.upper[pair] * x.segment<6>(6 * row);
    }
  }
  return y;
}

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
  const std::span<const int> unknowns = unknowns_of_block(pattern_);
  const int nb = pattern_.num_blocks(), num_panels = structure_.num_panels();
  VecX x(m_ * nb), below(m_ * nb);
  for (int k = 0; k < nb; ++k) {
    for (int r = 0; r < m_; ++r) x[m_ * structure_.position[k] + r] = rhs[6 * k + unknowns[r]];
  }
  for (int panel = 0; panel < num_panels; ++panel) {  // L y = rhs
    const int columns = structure_.num_columns(panel), rest = structure_.num_rows(panel) - columns;
    if (rest == 0) continue;
    const int n = m_ * columns, ld = m_ * (columns + rest);
    const double* own = x.data() + m_ * structure_.first_column[panel];
    cblas_dgemv(CblasColMajor, CblasNoTrans, m_ * rest, n, 1.0, lower_.data() + start(panel) + n, ld, own, 1,
                0.0, below.data(), 1);
    const int* rows = structure_.rows(panel) + columns;
    for (int i = 0; i < rest; ++i) {
      for (int r = 0; r < m_; ++r) x[m_ * rows[i] + r] -= below[m_ * i + r];
    }
  }
  for (int panel = num_panels - 1; panel >= 0; --panel) {  // D U x = y
    const int columns = structure_.num_columns(panel), rest = structure_.num_rows(panel) - columns;
    const int n = m_ * columns, ld = m_ * (columns + rest), one = 1;
    double* own = x.data() + m_ * structure_.first_column[panel];
    const int* rows = structure_.rows(panel) + columns;
    for (int i = 0; i < rest; ++i) {
      for (int r = 0; r < m_; ++r) below[m_ * i + r] = x[m_ * rows[i] + r];
    }
    if (rest > 0)
      cblas_dgemv(CblasColMajor, CblasTrans, m_ * rest, n, -1.0, upper_.data() + start(panel) + n, ld,
                  below.data(), 1, 1.0, own, 1);
    int info = 0;
    dgetrs_("N", &n, &one, lower_.data() + start(panel), &ld,
            pivots_.data() + m_ * structure_.first_column[panel], own, &n, &info);
  }
  VecX solution = rhs;  // rows that are no unknowns are those of the identity
  for (int k = 0; k < nb; ++k) {
    for (int r = 0; r < m_; ++r) solution[6 * k + unknowns[r]] = x[m_ * structure_.position[k] + r];
  }
  return solution;
}

}  // namespace cupola
