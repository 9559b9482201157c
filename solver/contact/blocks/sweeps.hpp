#pragma once

#include <vector>

#include "solver/contact/blocks/block_rows.hpp"

namespace cupola {

/// The off-diagonal blocks of a symmetric matrix A of n rows, in the order in which sweeps read them: in rows
/// 0 to n - 1 the lower triangle, in rows n to 2 n - 1 the upper one, its last row first. With gaps, or from
/// the end, the processor fetches memory three times as slowly.
SingleBlockRows in_order_of_sweeps(const BlockRows& A);

/// Block Gauss-Seidel on pieces of a fixed number of rows, on num_threads() threads. Same bits for any number
/// of threads. `A`: in the order of sweeps. `inverse`: of the diagonal blocks.
///
/// Forward sweep from x = 0; each piece takes the others as zero.
VecX sweep_forward(const SingleBlockRows& A, const std::vector<Mat6>& inverse, const VecX& r);

/// r - A x after a forward sweep: only the entries that the sweep has not used contribute.
VecX residual_after_sweep(const SingleBlockRows& A, const VecX& x);

/// Backward sweep on the residual r - A x; the transpose of sweep_forward.
void sweep_backward(const SingleBlockRows& A, const std::vector<Mat6>& inverse, const VecX& r, VecX* x);

/// Completes a forward sweep from x = 0 to a symmetric one within each piece: x <- (1 + D^-1 U)^-1 x with the
/// upper triangle U.
void complete_sweep(const SingleBlockRows& A, const std::vector<Mat6>& inverse, VecX* x);

}  // namespace cupola
