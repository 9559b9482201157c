#include "solver/contact/blocks/contact_jacobian.hpp"

#include <algorithm>
#include <cstring>

#include "assembly/base/error.hpp"
#include "solver/runtime/threads.hpp"

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

/// Keeps G, marks the 6x6 blocks that change and sets them to zero.
void ContactJacobian::mark_changed(const std::vector<Mat3>& G) {
  constexpr double kOperationsPerMark = 10.0;  // of a contact
  const int nc = problem_.num_contacts(), nb = problem_.num_blocks();
  contact_changes_.assign(nc, 0);
  block_changes_.assign(nb, 0);
  pair_changes_.assign(graph_.pattern.num_pairs(), 0);
  share_sums(kOperationsPerMark * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      if (std::memcmp(G[i].data(), G_[i].data(), sizeof(Mat3)) == 0) continue;
      G_[i] = G[i];
      contact_changes_[i] = 1;
    }
  });
  share_sums(kOperationsPerMark * nc, nb, [&](int first, int last) {
    const auto in_range = [&](int block) { return first <= block && block < last; };  // false for kFixed
    for (int i = 0; i < nc; ++i) {
      if (contact_changes_[i] == 0) continue;
      const int a = problem_.block_a[i], b = problem_.block_b[i], pair = graph_.pair_of_contact[i];
      for (const int block : {a, b}) {
        if (!in_range(block)) continue;
        block_changes_[block] = 1;
        J_.diagonal[block].setZero();
      }
      if (pair < 0 || !in_range(std::min(a, b))) continue;
      pair_changes_[pair] = 1;
      J_.lower[pair].setZero();
      J_.upper[pair].setZero();
    }
  });
}

/// Each thread visits all contacts and adds to its own range of blocks.
void ContactJacobian::sum_marked() {
  constexpr double kOperationsPerSum = 1000.0;  // of a contact
  const int nc = problem_.num_contacts();
  share_sums(kOperationsPerSum * nc, problem_.num_blocks(), [&](int first, int last) {
    const auto changes = [&](int block) {
      return first <= block && block < last && block_changes_[block] != 0;
    };
    for (int i = 0; i < nc; ++i) {
      const int a = problem_.block_a[i], b = problem_.block_b[i], pair = graph_.pair_of_contact[i];
      if ((!changes(a) && !changes(b)) || G_[i].isZero(0.0)) continue;
      const bool pair_changes = pair >= 0 && pair_changes_[pair] != 0 && changes(std::min(a, b));
      Mat63 D_a, D_b, D_a_G, D_b_G;
      if (changes(a) || pair_changes) {
        D_a = contact_columns(problem_, i, a);
        D_a_G = D_a.lazyProduct(G_[i]);
      }
      if ((changes(b) && b != a) || pair_changes) {
        D_b = contact_columns(problem_, i, b);
        D_b_G = D_b.lazyProduct(G_[i]);
      }
      if (changes(a)) J_.diagonal[a] += D_a_G.lazyProduct(D_a.transpose());
      if (changes(b) && b != a) J_.diagonal[b] += D_b_G.lazyProduct(D_b.transpose());
      if (!pair_changes) continue;
      (a < b ? J_.upper : J_.lower)[pair] += D_a_G.lazyProduct(D_b.transpose());
      (a < b ? J_.lower : J_.upper)[pair] += D_b_G.lazyProduct(D_a.transpose());
    }
  });
}

void ContactJacobian::whiten_marked() {
  constexpr double kOperationsPerColumn = 4000.0;
  const auto whiten = [&](int row, int column, Mat6* block) {
    *block = (white_.L_inverse[row] * *block * white_.L_inverse[column].transpose()).eval();
  };
  const BlockPattern& pattern = graph_.pattern;
  const auto whiten_column = [&](int column) {
    whiten(column, column, &J_.diagonal[column]);
    J_.diagonal[column].diagonal().array() += 1.0;
    for (int pair = pattern.column_start[column]; pair < pattern.column_start[column + 1]; ++pair) {
      if (pair_changes_[pair] == 0) continue;
      whiten(pattern.row[pair], column, &J_.lower[pair]);
      whiten(column, pattern.row[pair], &J_.upper[pair]);
    }
  };
  share_range(kOperationsPerColumn * pattern.num_blocks(), pattern.num_blocks(), [&](int first, int last) {
    for (int column = first; column < last; ++column)
      if (block_changes_[column] != 0) whiten_column(column);
  });
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
  constexpr double kOperationsPerPair = 144.0;
  VecX y(x.size());
  share_sums(kOperationsPerPair * pattern.num_pairs(), pattern.num_blocks(), [&](int first, int last) {
    const auto in_range = [&](int block) { return first <= block && block < last; };
    for (int k = first; k < last; ++k)
      y.segment<6>(6 * k).noalias() = matrix.diagonal[k] * x.segment<6>(6 * k);
    for (int k = 0; k < last; ++k) {
      for (int pair = pattern.column_start[k]; pair < pattern.column_start[k + 1]; ++pair) {
        const int row = pattern.row[pair];
        if (in_range(row)) y.segment<6>(6 * row).noalias() += matrix.lower[pair] * x.segment<6>(6 * k);
        if (in_range(k)) y.segment<6>(6 * k).noalias() += matrix.upper[pair] * x.segment<6>(6 * row);
      }
    }
  });
  return y;
}

}  // namespace cupola
