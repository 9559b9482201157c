#include "solver/contact/blocks/single_factor.hpp"

#include <algorithm>

#include <cblas.h>

#include "assembly/base/error.hpp"
#include "solver/contact/blocks/panel_solve.hpp"
#include "solver/runtime/threads.hpp"

extern "C" void dtrtri_(const char* uplo, const char* diag, const int* n, double* a, const int* lda,
                        int* info);

namespace cupola {

SingleFactor::SingleFactor(const FactorStructure& structure, int unknowns, std::span<const double> values) {
  // The rounding of L changes the solution by about 6e-8 times the condition number of L L^T. The smallest
  // eigenvalue of systems M + D G D^T with M = I is at least 1, and the largest is of the size of the largest
  // squared diagonal entry of L.
  constexpr double kLargest = 1e3;
  const int m = unknowns;
  double largest = 0.0;
  for (int panel = 0; panel < structure.num_panels(); ++panel) {
    const double* L = values.data() + m * m * structure.value_start[panel];
    const std::int64_t ld = std::int64_t{m} * structure.num_rows(panel);
    for (int i = 0; i < m * structure.num_columns(panel); ++i) largest = std::max(largest, L[i * ld + i]);
  }
  accurate_ = largest <= kLargest;
  if (!accurate_) return;
  values_.resize(values.size());
  const auto invert = [&](int panel, std::vector<double>* work) {
    const int n = m * structure.num_columns(panel), ld = m * structure.num_rows(panel), rest = ld - n;
    const std::int64_t start = m * m * structure.value_start[panel];
    work->assign(values.begin() + start, values.begin() + start + std::int64_t{n} * ld);
    for (int c = 1; c < n; ++c) std::fill_n(work->begin() + std::int64_t{c} * ld, c, 0.0);
    int info = 0;
    dtrtri_("L", "N", &n, work->data(), &ld, &info);
    CUPOLA_ASSERT(info == 0);
    if (rest > 0)
      cblas_dtrmm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, rest, n, 1.0,
                  work->data(), ld, work->data() + n, ld);
    std::transform(work->begin(), work->end(), values_.begin() + start,
                   [](double value) { return static_cast<float>(value); });
  };
  constexpr double kOperationsPerValue = 50.0;
  share_range(kOperationsPerValue * static_cast<double>(values.size()), structure.num_panels(),
              [&](int first, int last) {
                std::vector<double> work;
                for (int panel = first; panel < last; ++panel) invert(panel, &work);
              });
}

VecX SingleFactor::solve(const BlockPattern& pattern, const FactorStructure& structure,
                         const VecX& rhs) const {
  CUPOLA_ASSERT(accurate_ && !values_.empty());
  const int m = static_cast<int>(unknowns_of_block(pattern).size());
  const auto multiply = [&](int panel, CBLAS_TRANSPOSE transposed, const float* by, float* result) {
    const int n = m * structure.num_columns(panel), ld = m * structure.num_rows(panel);
    cblas_sgemv(CblasColMajor, transposed, ld, n, 1.0F, values_.data() + m * m * structure.value_start[panel],
                ld, by, 1, 0.0F, result, 1);
  };
  return solve_by_panels<float>(
      pattern, structure, rhs,
      [&](int panel, const float* own, float* product) { multiply(panel, CblasNoTrans, own, product); },
      [&](int panel, const float* product, float* own) { multiply(panel, CblasTrans, product, own); });
}

}  // namespace cupola
