#include "solver/contact/block_cholesky.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <numeric>
#include <span>

#include <cholmod.h>
#include <dlfcn.h>

#include "assembly/error.hpp"

namespace cupola {

namespace {

/// OpenBLAS with several threads sums in an order that depends on their number. CHOLMOD's own OpenMP threads
/// copy only, but they spin while they wait: on two cores they doubled the time. Looked up at run time
/// because both libraries are CHOLMOD's choice, not ours; where one is absent there is nothing to set.
void use_one_thread() {
  static const bool done = [] {
    using SetInt = void (*)(int);
    const auto call = [](const char* name, int value) {
      if (const auto function = reinterpret_cast<SetInt>(dlsym(RTLD_DEFAULT, name))) function(value);
    };
    call("openblas_set_num_threads", 1);
    call("omp_set_max_active_levels", 0);
    return true;
  }();
  static_cast<void>(done);
}

using Index = SuiteSparse_long;

/// Rows of each block that are unknowns.
std::span<const int> rows_of(const BlockPattern& pattern) {
  static constexpr std::array kAll{0, 1, 2, 3, 4, 5};
  static constexpr std::array kPlane{0, 2, 4};  // x, z, rot y
  return pattern.plane ? std::span<const int>(kPlane) : std::span<const int>(kAll);
}

}  // namespace

struct BlockCholesky::Implementation {
  cholmod_common common;
  cholmod_sparse* A = nullptr;  ///< scalar lower triangle, packed
  cholmod_factor* L = nullptr;
  cholmod_dense *X = nullptr, *Y = nullptr, *work = nullptr;  ///< of solve, kept from call to call
  BlockPattern pattern;
  bool valid = false;

  Implementation() {
    use_one_thread();
    cholmod_l_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
    common.try_catch = 1;  // a failed factorisation is reported by its return value, not on stderr
  }
  ~Implementation() {
    release();
    cholmod_l_finish(&common);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void release() {
    cholmod_l_free_sparse(&A, &common);
    cholmod_l_free_factor(&L, &common);
    cholmod_l_free_dense(&X, &common);
    cholmod_l_free_dense(&Y, &common);
    cholmod_l_free_dense(&work, &common);
  }
  void throw_if_out_of_memory() const {
    if (common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  }
  std::vector<Index> block_order();
  void analyze(const BlockPattern& new_pattern);
  void fill_structure();
  void fill_values(const BlockMatrix& matrix);
};

/// METIS order of the blocks; the natural one where METIS has nothing to do.
std::vector<Index> BlockCholesky::Implementation::block_order() {
  const Index nb = pattern.num_blocks();
  std::vector<Index> order(nb);
  std::iota(order.begin(), order.end(), Index{0});
  if (pattern.num_pairs() == 0) return order;

  cholmod_sparse* graph =
      cholmod_l_allocate_sparse(nb, nb, pattern.num_pairs(), 1, 1, -1, CHOLMOD_PATTERN, &common);
  throw_if_out_of_memory();
  std::copy(pattern.column_start.begin(), pattern.column_start.end(), static_cast<Index*>(graph->p));
  std::copy(pattern.row.begin(), pattern.row.end(), static_cast<Index*>(graph->i));
  const bool ordered = cholmod_l_metis(graph, nullptr, 0, 1, order.data(), &common) != 0;
  cholmod_l_free_sparse(&graph, &common);
  throw_if_out_of_memory();
  if (!ordered) std::iota(order.begin(), order.end(), Index{0});
  return order;
}

/// Column m k + c, m rows per block, holds rows c..m-1 of the diagonal block, then the m rows of each block
/// below.
void BlockCholesky::Implementation::fill_structure() {
  const Index m = std::ssize(rows_of(pattern));
  auto* p = static_cast<Index*>(A->p);
  auto* i = static_cast<Index*>(A->i);
  Index next = 0;
  for (int k = 0; k < pattern.num_blocks(); ++k) {
    for (Index c = 0; c < m; ++c) {
      p[m * k + c] = next;
      for (Index r = c; r < m; ++r) i[next++] = m * k + r;
      for (int q = pattern.column_start[k]; q < pattern.column_start[k + 1]; ++q) {
        for (Index r = 0; r < m; ++r) i[next++] = m * pattern.row[q] + r;
      }
    }
  }
  p[m * pattern.num_blocks()] = next;
}

void BlockCholesky::Implementation::fill_values(const BlockMatrix& matrix) {
  const std::span<const int> rows = rows_of(pattern);
  auto* x = static_cast<double*>(A->x);
  Index next = 0;
  for (int k = 0; k < pattern.num_blocks(); ++k) {
    for (std::size_t c = 0; c < rows.size(); ++c) {
      for (std::size_t r = c; r < rows.size(); ++r) x[next++] = matrix.diagonal[k](rows[r], rows[c]);
      for (int q = pattern.column_start[k]; q < pattern.column_start[k + 1]; ++q) {
        for (const int r : rows) x[next++] = matrix.lower[q](r, rows[c]);
      }
    }
  }
}

void BlockCholesky::Implementation::analyze(const BlockPattern& new_pattern) {
  release();
  pattern = new_pattern;
  const Index m = std::ssize(rows_of(pattern));
  const Index n = m * pattern.num_blocks();
  const Index num_entries = m * (m + 1) / 2 * pattern.num_blocks() + m * m * pattern.num_pairs();
  A = cholmod_l_allocate_sparse(n, n, num_entries, 1, 1, -1, CHOLMOD_REAL, &common);
  throw_if_out_of_memory();
  fill_structure();

  std::vector<Index> order(n);
  const std::vector<Index> blocks = block_order();
  for (Index k = 0; k < n; ++k) order[k] = m * blocks[k / m] + k % m;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = 1;
  L = cholmod_l_analyze_p(A, order.data(), nullptr, 0, &common);
  throw_if_out_of_memory();
  CUPOLA_ASSERT(L != nullptr);
}

BlockCholesky::BlockCholesky() : implementation_(std::make_unique<Implementation>()) {}
BlockCholesky::~BlockCholesky() = default;
BlockCholesky::BlockCholesky(BlockCholesky&&) noexcept = default;
BlockCholesky& BlockCholesky::operator=(BlockCholesky&&) noexcept = default;

bool BlockCholesky::factorize(const BlockPattern& pattern, const BlockMatrix& matrix) {
  Implementation& self = *implementation_;
  if (self.L == nullptr || self.pattern != pattern) self.analyze(pattern);
  self.fill_values(matrix);
  cholmod_l_factorize(self.A, self.L, &self.common);
  self.throw_if_out_of_memory();
  // CHOLMOD lets NaN through: a product with NaN is neither positive nor not.
  const auto finite = [](const Mat6& block) { return block.allFinite(); };
  self.valid = self.common.status == CHOLMOD_OK && self.L->minor == self.L->n &&
               std::all_of(matrix.diagonal.begin(), matrix.diagonal.end(), finite) &&
               std::all_of(matrix.lower.begin(), matrix.lower.end(), finite);
  return self.valid;
}

bool BlockCholesky::has_factor() const {
  return implementation_->valid;
}

const BlockPattern& BlockCholesky::pattern() const {
  return implementation_->pattern;
}

VecX BlockCholesky::solve(const VecX& rhs) const {
  Implementation& self = *implementation_;
  const std::span<const int> rows = rows_of(self.pattern);
  const auto m = static_cast<Eigen::Index>(rows.size());
  CUPOLA_ASSERT(self.valid && rhs.size() == 6 * self.pattern.num_blocks());
  if (rhs.size() == 0) return rhs;
  VecX unknowns(m * self.pattern.num_blocks());
  for (Eigen::Index i = 0; i < unknowns.size(); ++i) unknowns[i] = rhs[6 * (i / m) + rows[i % m]];
  cholmod_dense B{};
  B.nrow = B.nzmax = B.d = static_cast<std::size_t>(unknowns.size());
  B.ncol = 1;
  B.x = unknowns.data();
  B.xtype = CHOLMOD_REAL;
  B.dtype = CHOLMOD_DOUBLE;
  cholmod_l_solve2(CHOLMOD_A, self.L, &B, nullptr, &self.X, nullptr, &self.Y, &self.work, &self.common);
  self.throw_if_out_of_memory();
  VecX x = rhs;  // what is no unknown has the identity for its rows
  const auto* found = static_cast<const double*>(self.X->x);
  for (Eigen::Index i = 0; i < unknowns.size(); ++i) x[6 * (i / m) + rows[i % m]] = found[i];
  return x;
}

long long BlockCholesky::num_nonzeros() const {
  const cholmod_factor* L = implementation_->L;
  return L == nullptr ? 0 : static_cast<long long>(L->is_super ? L->xsize : L->nzmax);
}

}  // namespace cupola
