#pragma once

#include <random>

#include "solver/contact/blocks/block_matrix.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::testing {

/// Random numbers between -0.5 and 0.5 with a fixed seed.
inline VecX random_vector(Eigen::Index n) {
  std::mt19937 random(7);
  VecX x(n);
  for (double& value : x) value = random() / 4294967296.0 - 0.5;
  return x;
}

/// The contact problem of a dome and its graph, as the source of block patterns.
struct DomeBlocks {
  ContactProblem problem;
  ContactGraph graph;

  DomeBlocks(int rings, int blocks_per_ring)
      : problem(scenes::dome({.rings = rings, .blocks_per_ring = blocks_per_ring}, 1.0, {0.4, 1e-8, 1e-8})),
        graph(contact_graph(problem)) {}
};

/// The dense matrix of a block matrix whose block (column, row) of a pair is `upper(pair)`.
template <class Matrix, class Upper>
Eigen::MatrixXd dense_matrix(const BlockPattern& pattern, const Matrix& matrix, const Upper& upper) {
  const int nb = pattern.num_blocks();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6 * nb, 6 * nb);
  for (int k = 0; k < nb; ++k) {
    A.block<6, 6>(6 * k, 6 * k) = matrix.diagonal[k];
    for (int q = pattern.column_start[k]; q < pattern.column_start[k + 1]; ++q) {
      A.block<6, 6>(6 * pattern.row[q], 6 * k) = matrix.lower[q];
      A.block<6, 6>(6 * k, 6 * pattern.row[q]) = upper(q);
    }
  }
  return A;
}

}  // namespace cupola::testing
