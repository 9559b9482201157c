#include "solver/contact/blocks/block_lu.hpp"

#include <array>
#include <new>

#include <cblas.h>
#include <umfpack.h>

#include "assembly/base/error.hpp"

namespace cupola {

namespace {

static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));

const SuiteSparse_long* indices(const std::vector<std::int64_t>& values) {
  return reinterpret_cast<const SuiteSparse_long*>(values.data());
}

std::array<double, UMFPACK_CONTROL> controls() {
  std::array<double, UMFPACK_CONTROL> control;
  umfpack_dl_defaults(control.data());
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  control[UMFPACK_IRSTEP] = 0;  // Newton corrects rounding errors itself
  control[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
  return control;
}

/// Visits the blocks of the full matrix by columns, rows ascending: visit(row, column, block).
template <class Visit>
void for_each_block(const BlockPattern& pattern, const std::vector<std::vector<int>>& pairs_above,
                    const UnsymmetricBlockMatrix* matrix, Visit visit) {
  const Mat6 none = Mat6::Zero();
  std::vector<int> column_of_pair(pattern.num_pairs());
  for (int k = 0; k < pattern.num_blocks(); ++k)
    for (int pair = pattern.column_start[k]; pair < pattern.column_start[k + 1]; ++pair)
      column_of_pair[pair] = k;
  for (int k = 0; k < pattern.num_blocks(); ++k) {
    for (const int pair : pairs_above[k]) visit(column_of_pair[pair], k, matrix ? matrix->upper[pair] : none);
    visit(k, k, matrix ? matrix->diagonal[k] : none);
    for (int pair = pattern.column_start[k]; pair < pattern.column_start[k + 1]; ++pair)
      visit(pattern.row[pair], k, matrix ? matrix->lower[pair] : none);
  }
}

/// For each block, the pairs whose larger block it is, by their smaller blocks.
std::vector<std::vector<int>> pairs_above_diagonal(const BlockPattern& pattern) {
  std::vector<std::vector<int>> pairs(pattern.num_blocks());
  for (int pair = 0; pair < pattern.num_pairs(); ++pair) pairs[pattern.row[pair]].push_back(pair);
  return pairs;
}

}  // namespace

UnsymmetricBlockMatrix assemble_jacobian(const ContactProblem& problem, const ContactGraph& graph,
                                         const std::vector<Mat3>& G) {
  CUPOLA_ASSERT(std::ssize(G) == problem.num_contacts());
  const std::vector<Mat6> zeros(graph.pattern.num_pairs(), Mat6::Zero());
  UnsymmetricBlockMatrix J{problem.M, zeros, zeros};
  for (int i = 0; i < problem.num_contacts(); ++i) {
    if (G[i].isZero(0.0)) continue;
    const int a = problem.block_a[i], b = problem.block_b[i], pair = graph.pair_of_contact[i];
    const Mat63 &D_a = problem.D_a[i], &D_b = problem.D_b[i];
    Mat63 D_a_G, D_b_G;
    if (a != ContactProblem::kFixed) {
      D_a_G.noalias() = D_a * G[i];
      J.diagonal[a].noalias() += D_a_G * D_a.transpose();
    }
    if (b != ContactProblem::kFixed) {
      D_b_G.noalias() = D_b * G[i];
      J.diagonal[b].noalias() += D_b_G * D_b.transpose();
    }
    if (pair < 0) continue;
    (a < b ? J.upper : J.lower)[pair].noalias() += D_a_G * D_b.transpose();
    (a < b ? J.lower : J.upper)[pair].noalias() += D_b_G * D_a.transpose();
  }
  return J;
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

void BlockLu::FreeSymbolic::operator()(void* symbolic) const {
  umfpack_dl_free_symbolic(&symbolic);
}
void BlockLu::FreeNumeric::operator()(void* numeric) const {
  umfpack_dl_free_numeric(&numeric);
}

void BlockLu::analyze(const BlockPattern& pattern) {
  symbolic_.reset();
  pattern_ = pattern;
  const std::span<const int> unknowns = unknowns_of_block(pattern);
  m_ = static_cast<int>(unknowns.size());
  column_start_.assign(1, 0);
  row_.clear();
  std::vector<int> rows;  // of the current block column
  const auto close_column = [&] {
    for (int c = 0; c < m_; ++c) {
      for (const int block : rows)
        for (int r = 0; r < m_; ++r) row_.push_back(std::int64_t{m_} * block + r);
      column_start_.push_back(std::ssize(row_));
    }
    rows.clear();
  };
  int current = 0;
  for_each_block(pattern, pairs_above_diagonal(pattern), nullptr, [&](int row, int column, const Mat6&) {
    if (column != current) close_column();
    current = column;
    rows.push_back(row);
  });
  if (pattern.num_blocks() > 0) close_column();
  value_.resize(row_.size());
  const std::int64_t n = std::int64_t{m_} * pattern.num_blocks();
  const auto control = controls();
  void* symbolic = nullptr;
  const auto status = umfpack_dl_symbolic(n, n, indices(column_start_), indices(row_), nullptr, &symbolic,
                                          control.data(), nullptr);
  symbolic_.reset(symbolic);
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  CUPOLA_ASSERT(status == UMFPACK_OK);
}

void BlockLu::fill(const UnsymmetricBlockMatrix& matrix) {
  const std::span<const int> unknowns = unknowns_of_block(pattern_);
  std::vector<std::int64_t> next(column_start_.begin(), column_start_.end() - 1);
  for_each_block(pattern_, pairs_above_diagonal(pattern_), &matrix, [&](int, int column, const Mat6& block) {
    for (int c = 0; c < m_; ++c)
      for (int r = 0; r < m_; ++r) value_[next[m_ * column + c]++] = block(unknowns[r], unknowns[c]);
  });
}

bool BlockLu::factorize(const BlockPattern& pattern, const UnsymmetricBlockMatrix& matrix) {
  CUPOLA_ASSERT(std::ssize(matrix.diagonal) == pattern.num_blocks());
  CUPOLA_ASSERT(std::ssize(matrix.lower) == pattern.num_pairs());
  openblas_set_num_threads(1);
  numeric_.reset();
  if (!symbolic_ || pattern_ != pattern) analyze(pattern);
  fill(matrix);
  for (const double value : value_)
    if (!std::isfinite(value)) return false;
  const auto control = controls();
  void* numeric = nullptr;
  const auto status = umfpack_dl_numeric(indices(column_start_), indices(row_), value_.data(),
                                         symbolic_.get(), &numeric, control.data(), nullptr);
  numeric_.reset(numeric);
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  if (status != UMFPACK_OK) numeric_.reset();
  return status == UMFPACK_OK;
}

VecX BlockLu::solve(const VecX& rhs) const {
  CUPOLA_ASSERT(numeric_ && rhs.size() == 6 * pattern_.num_blocks());
  const std::span<const int> unknowns = unknowns_of_block(pattern_);
  const int nb = pattern_.num_blocks();
  VecX b(m_ * nb), x(m_ * nb);
  for (int k = 0; k < nb; ++k)
    for (int r = 0; r < m_; ++r) b[m_ * k + r] = rhs[6 * k + unknowns[r]];
  const auto control = controls();
  umfpack_dl_solve(UMFPACK_A, indices(column_start_), indices(row_), value_.data(), x.data(), b.data(),
                   numeric_.get(), control.data(), nullptr);
  VecX solution = rhs;  // rows that are no unknowns are those of the identity
  for (int k = 0; k < nb; ++k)
    for (int r = 0; r < m_; ++r) solution[6 * k + unknowns[r]] = x[m_ * k + r];
  return solution;
}

}  // namespace cupola
