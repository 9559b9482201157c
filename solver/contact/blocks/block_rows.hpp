#pragma once

#include <vector>

#include "solver/contact/blocks/block_matrix.hpp"

namespace cupola {

/// Sparse matrix of 6x6 blocks, stored by rows. Symmetric matrices are stored in full.
template <class Scalar>
struct BlockRowsOf {
  std::vector<int> start{0};                       ///< first entry of each row, and the end (rows + 1)
  std::vector<int> column;                         ///< ascending within a row (entries)
  std::vector<Eigen::Matrix<Scalar, 6, 6>> value;  ///< (entries)
  int num_columns = 0;
  int num_rows() const { return static_cast<int>(start.size()) - 1; }
};
using BlockRows = BlockRowsOf<double>;
/// Half the memory traffic, for preconditioners.
using SingleBlockRows = BlockRowsOf<float>;

/// The full symmetric matrix.
BlockRows both_triangles(const BlockPattern& pattern, const BlockMatrix& matrix);

/// Matrix times vector (6 num_columns), on num_threads() threads. Same bits for any number of threads.
VecX multiply(const BlockRows& A, const VecX& x);
VecX multiply(const SingleBlockRows& A, const VecX& x);

/// A B, on num_threads() threads. Same bits for any number of threads.
BlockRows multiply(const BlockRows& A, const BlockRows& B);

/// P^T A P in double precision, without A P as a whole, which takes more memory than A. Runs on num_threads()
/// threads, with the same bits for any number. `P_transposed`: of P.
BlockRows galerkin_product(const BlockRows& A, const SingleBlockRows& P, const SingleBlockRows& P_transposed);

SingleBlockRows transpose(const SingleBlockRows& A);

SingleBlockRows in_single_precision(const BlockRows& A);

}  // namespace cupola
