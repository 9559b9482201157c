#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "solver/contact/blocks/factor_structure.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

/// Solves L U x = b with a factor by panels, each of which has its own rows and rows below them:
///
///     forward(panel, own, product):   from own rows of b, those of L^-1 b, and below them what they subtract
///     backward(panel, product, own):  from own rows of L^-1 b, and below them -x, the own rows of x
///
/// Runs on num_threads() threads: subtrees beside each other, the top between them. What a subtree subtracts
/// from rows of the top is summed apart, so that the bits are the same for any number of threads. Rows of
/// `rhs` that are no unknowns of the pattern are returned as they are.
template <class Scalar, class Forward, class Backward>
VecX solve_by_panels(const BlockPattern& pattern, const FactorStructure& f, const VecX& rhs,
                     const Forward& forward, const Backward& backward) {
  constexpr double kOperationsPerValue = 4.0;
  const std::span<const int> unknowns = unknowns_of_block(pattern);
  const int m = static_cast<int>(unknowns.size()), nb = pattern.num_blocks();
  std::vector<Scalar> x(m * (nb + f.top_row.size()));  // then the sums of the subtrees
  for (int k = 0; k < nb; ++k)
    for (int r = 0; r < m; ++r) x[m * f.position[k] + r] = static_cast<Scalar>(rhs[6 * k + unknowns[r]]);
  std::vector<std::vector<Scalar>> products(num_threads(), std::vector<Scalar>(m * f.most_rows));

  const auto substitute_forward = [&](int panel, Scalar* product) {
    Scalar* own = x.data() + m * f.first_column[panel];
    forward(panel, own, product);
    std::copy_n(product, m * f.num_columns(panel), own);
    const int* targets = f.target.data() + f.row_start[panel];
    for (int i = f.num_columns(panel); i < f.num_rows(panel); ++i)
      for (int r = 0; r < m; ++r) x[m * targets[i] + r] -= product[m * i + r];
  };
  const auto substitute_backward = [&](int panel, Scalar* product) {
    Scalar* own = x.data() + m * f.first_column[panel];
    std::copy_n(own, m * f.num_columns(panel), product);
    const int* rows = f.rows(panel);
    for (int i = f.num_columns(panel); i < f.num_rows(panel); ++i)
      for (int r = 0; r < m; ++r) product[m * i + r] = -x[m * rows[i] + r];
    backward(panel, product, own);
  };
  const auto substitute_in_top = [&](Scalar* product) {
    for (std::size_t k = 0; k < f.top_row.size(); ++k)
      for (int r = 0; r < m; ++r) x[m * f.top_row[k] + r] += x[m * (nb + k) + r];
    for (const int panel : f.top) substitute_forward(panel, product);
    for (auto panel = f.top.rbegin(); panel != f.top.rend(); ++panel) substitute_backward(*panel, product);
  };
  const auto num_trees = static_cast<int>(f.subtrees.size());
  const double work = kOperationsPerValue * m * m * static_cast<double>(f.value_start.back());
  run_team(work, [&](Team& team, int thread) {
    Scalar* product = products[thread].data();
    team.share(num_trees, [&](int i) {
      for (int k = f.subtrees[i].first; k < f.subtrees[i].last; ++k) substitute_forward(k, product);
    });
    team.share(1, [&](int) { substitute_in_top(product); });
    team.share(num_trees, [&](int i) {
      for (int k = f.subtrees[i].last - 1; k >= f.subtrees[i].first; --k) substitute_backward(k, product);
    });
  });

  VecX solution = rhs;
  for (int k = 0; k < nb; ++k)
    for (int r = 0; r < m; ++r) solution[6 * k + unknowns[r]] = x[m * f.position[k] + r];
  return solution;
}

}  // namespace cupola
