#include "solver/contact/blocks/block_matrix.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "assembly/base/error.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

namespace {

bool joins_two_free(const ContactProblem& p, int i) {
  const int a = p.block_a[i], b = p.block_b[i];
  return a != ContactProblem::kFixed && b != ContactProblem::kFixed && a != b;
}

std::pair<int, int> column_and_row(const ContactProblem& p, int i) {
  return std::minmax(p.block_a[i], p.block_b[i]);
}

}  // namespace

std::span<const int> unknowns_of_block(const BlockPattern& pattern) {
  static constexpr std::array kAll{0, 1, 2, 3, 4, 5};
  static constexpr std::array kPlane{0, 2, 4};  // x, z, rot y
  return pattern.plane ? std::span<const int>(kPlane) : std::span<const int>(kAll);
}

ContactGraph contact_graph(const ContactProblem& problem) {
  const int nb = problem.num_blocks(), nc = problem.num_contacts();
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(nc);
  for (int i = 0; i < nc; ++i) {
    if (!joins_two_free(problem, i)) continue;
    const std::pair<int, int> pair = column_and_row(problem, i);
    if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);  // contacts of a joint are neighbours
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

  ContactGraph graph;
  graph.pattern.plane = problem.plane;
  graph.pattern.column_start.assign(nb + 1, 0);
  graph.pattern.row.reserve(pairs.size());
  for (const auto& [column, row] : pairs) {
    ++graph.pattern.column_start[column + 1];
    graph.pattern.row.push_back(row);
  }
  for (int k = 0; k < nb; ++k) graph.pattern.column_start[k + 1] += graph.pattern.column_start[k];

  graph.pair_of_contact.assign(nc, -1);
  auto position = pairs.end();
  for (int i = 0; i < nc; ++i) {
    if (!joins_two_free(problem, i)) continue;
    const std::pair<int, int> pair = column_and_row(problem, i);
    if (position == pairs.end() || *position != pair)
      position = std::lower_bound(pairs.begin(), pairs.end(), pair);
    graph.pair_of_contact[i] = static_cast<int>(position - pairs.begin());
  }
  return graph;
}

namespace {

constexpr double kOperationsPerContact = 1000.0;

/// Adds sum_i D_i G_i D_i^T. Each thread visits all contacts and adds to its own range of blocks.
void add_stiffness(const ContactProblem& problem, const ContactGraph& graph, const std::vector<Mat3>& G,
                   BlockMatrix* H) {
  CUPOLA_ASSERT(std::ssize(G) == problem.num_contacts());
  CUPOLA_ASSERT(std::ssize(graph.pair_of_contact) == problem.num_contacts());
  share_sums(kOperationsPerContact * problem.num_contacts(), problem.num_blocks(), [&](int first, int last) {
    const auto in_range = [&](int block) { return first <= block && block < last; };  // false for kFixed
    for (int i = 0; i < problem.num_contacts(); ++i) {
      const int a = problem.block_a[i], b = problem.block_b[i];
      if ((!in_range(a) && !in_range(b)) || G[i].isZero(0.0)) continue;
      Mat63 D_a, D_b, D_a_G, D_b_G;
      if (a != ContactProblem::kFixed) {
        D_a = contact_columns(problem, i, a);
        D_a_G = D_a.lazyProduct(G[i]);
      }
      if (b != ContactProblem::kFixed && b != a) {
        D_b = contact_columns(problem, i, b);
        D_b_G = D_b.lazyProduct(G[i]);
      }
      if (in_range(a)) H->diagonal[a] += D_a_G.lazyProduct(D_a.transpose());
      if (in_range(b) && b != a) H->diagonal[b] += D_b_G.lazyProduct(D_b.transpose());
      const int pair = graph.pair_of_contact[i];
      if (pair < 0 || !in_range(std::min(a, b))) continue;
      H->lower[pair] += (a > b ? D_a_G : D_b_G).lazyProduct((a > b ? D_b : D_a).transpose());
    }
  });
}

BlockMatrix zero_matrix(const BlockPattern& pattern) {
  return {std::vector<Mat6>(pattern.num_blocks(), Mat6::Zero()),
          std::vector<Mat6>(pattern.num_pairs(), Mat6::Zero())};
}

}  // namespace

BlockMatrix assemble_hessian(const ContactProblem& problem, const ContactGraph& graph,
                             const std::vector<Mat3>& G) {
  BlockMatrix H{problem.M, std::vector<Mat6>(graph.pattern.num_pairs(), Mat6::Zero())};
  add_stiffness(problem, graph, G, &H);
  return H;
}

BlockMatrix assemble_stiffness(const WhitenedProblem& problem, const ContactGraph& graph,
                               const std::vector<Mat3>& G) {
  constexpr double kOperationsPerColumn = 4000.0;
  BlockMatrix H = zero_matrix(graph.pattern);
  add_stiffness(problem.given, graph, G, &H);
  const std::vector<Mat6>& to_w = problem.L_inverse;
  const int nb = graph.pattern.num_blocks();
  share_range(kOperationsPerColumn * nb, nb, [&](int first, int last) {
    for (int column = first; column < last; ++column) {
      const auto whiten = [&](int row, Mat6* block) {
        *block = (to_w[row] * *block * to_w[column].transpose()).eval();
      };
      whiten(column, &H.diagonal[column]);
      for (int p = graph.pattern.column_start[column]; p < graph.pattern.column_start[column + 1]; ++p)
        whiten(graph.pattern.row[p], &H.lower[p]);
    }
  });
  return H;
}

BlockMatrix assemble_hessian(const WhitenedProblem& problem, const ContactGraph& graph,
                             const std::vector<Mat3>& G) {
  BlockMatrix H = assemble_stiffness(problem, graph, G);
  for (Mat6& block : H.diagonal) block.diagonal().array() += 1.0;
  return H;
}

VecX multiply(const BlockPattern& pattern, const BlockMatrix& matrix, const VecX& x) {
  CUPOLA_ASSERT(x.size() == 6 * pattern.num_blocks());
  VecX result(x.size());
  constexpr double kOperationsPerPair = 144.0;
  share_sums(kOperationsPerPair * pattern.num_pairs(), pattern.num_blocks(), [&](int first, int last) {
    const auto in_range = [&](int block) { return first <= block && block < last; };
    for (int k = first; k < last; ++k)
      result.segment<6>(6 * k).noalias() = matrix.diagonal[k] * x.segment<6>(6 * k);
    for (int column = 0; column < last; ++column) {
      for (int p = pattern.column_start[column]; p < pattern.column_start[column + 1]; ++p) {
        const int row = pattern.row[p];
        if (in_range(row)) result.segment<6>(6 * row).noalias() += matrix.lower[p] * x.segment<6>(6 * column);
        if (in_range(column))
          result.segment<6>(6 * column).noalias() += matrix.lower[p].transpose() * x.segment<6>(6 * row);
      }
    }
  });
  return result;
}

}  // namespace cupola
