#include "solver/contact/blocks/sweeps.hpp"

#include <algorithm>

#include "solver/runtime/threads.hpp"

namespace cupola {

namespace {

/// Rows that a sweep visits in sequence: an eighth of all, so that threads share them.
int piece_size(int num_rows) {
  constexpr int kShare = 8, kSmallest = 1024, kLargest = 4096;
  return std::clamp(num_rows / kShare, kSmallest, kLargest);
}

constexpr double kOperationsPerBlockProduct = 72.0;

/// Calls body(first, last) for each piece of a sweep.
template <class Body>
void share_pieces(const SingleBlockRows& A, const Body& body) {
  const int n = A.num_columns, size = piece_size(n);
  share_loop(kOperationsPerBlockProduct * static_cast<double>(A.value.size()), (n + size - 1) / size,
             [&](int piece) { body(piece * size, std::min(n, (piece + 1) * size)); });
}

/// Subtracts the product of the entries first to last - 1 with x.
void subtract(const SingleBlockRows& A, int first, int last, const VecX& x, Vec6* sum) {
  for (int k = first; k < last; ++k)
    *sum -= A.value[k].cast<double>().lazyProduct(x.segment<6>(6 * A.column[k]));
}

/// Row of the upper triangle.
int upper_row(const SingleBlockRows& A, int i) {
  return 2 * A.num_columns - 1 - i;
}

/// First entry of the row whose column is at least `column`.
template <class Scalar>
int entry_from(const BlockRowsOf<Scalar>& A, int row, int column) {
  int k = A.start[row];
  while (k < A.start[row + 1] && A.column[k] < column) ++k;
  return k;
}

}  // namespace

SingleBlockRows in_order_of_sweeps(const BlockRows& A) {
  const int n = A.num_rows();
  std::vector<int> diagonal(n);
  for (int i = 0; i < n; ++i) diagonal[i] = entry_from(A, i, i);
  SingleBlockRows S;
  S.num_columns = n;
  const auto end_row = [&](int num_entries) { S.start.push_back(S.start.back() + num_entries); };
  for (int i = 0; i < n; ++i) end_row(diagonal[i] - A.start[i]);
  for (int i = n - 1; i >= 0; --i) end_row(A.start[i + 1] - diagonal[i] - 1);
  S.column.resize(S.start.back());
  S.value.resize(S.start.back());
  share_range(kOperationsPerBlockProduct * static_cast<double>(A.value.size()), n, [&](int first, int last) {
    const auto copy = [&](int from, int end, int row) {
      for (int to = S.start[row]; from < end; ++from, ++to) {
        S.column[to] = A.column[from];
        S.value[to] = A.value[from].cast<float>();
      }
    };
    for (int i = first; i < last; ++i) {
      copy(A.start[i], diagonal[i], i);
      copy(diagonal[i] + 1, A.start[i + 1], upper_row(S, i));
    }
  });
  return S;
}

VecX sweep_forward(const SingleBlockRows& A, const std::vector<Mat6>& inverse, const VecX& r) {
  VecX x(r.size());
  share_pieces(A, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      Vec6 sum = r.segment<6>(6 * i);
      subtract(A, entry_from(A, i, first), A.start[i + 1], x, &sum);
      x.segment<6>(6 * i).noalias() = inverse[i] * sum;
    }
  });
  return x;
}

VecX residual_after_sweep(const SingleBlockRows& A, const VecX& x) {
  VecX residual(x.size());
  share_pieces(A, [&](int first, int last) {
    for (int i = last - 1; i >= first; --i) {
      const int row = upper_row(A, i);
      Vec6 sum = Vec6::Zero();
      subtract(A, A.start[i], entry_from(A, i, first), x, &sum);
      subtract(A, A.start[row], A.start[row + 1], x, &sum);
      residual.segment<6>(6 * i) = sum;
    }
  });
  return residual;
}

void sweep_backward(const SingleBlockRows& A, const std::vector<Mat6>& inverse, const VecX& r, VecX* x) {
  const VecX before = *x;
  VecX rest(r.size());
  share_pieces(A, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      Vec6 sum = r.segment<6>(6 * i);
      subtract(A, A.start[i], A.start[i + 1], before, &sum);
      rest.segment<6>(6 * i) = sum;
    }
    for (int i = last - 1; i >= first; --i) {
      const int row = upper_row(A, i), outside = entry_from(A, row, last);
      Vec6 sum = rest.segment<6>(6 * i);
      subtract(A, A.start[row], outside, *x, &sum);
      subtract(A, outside, A.start[row + 1], before, &sum);
      x->segment<6>(6 * i).noalias() = inverse[i] * sum;
    }
  });
}

void complete_sweep(const SingleBlockRows& A, const std::vector<Mat6>& inverse, VecX* x) {
  share_pieces(A, [&](int first, int last) {
    for (int i = last - 1; i >= first; --i) {
      const int row = upper_row(A, i);
      Vec6 sum = Vec6::Zero();
      for (int k = entry_from(A, row, last) - 1; k >= A.start[row]; --k)
        sum += A.value[k].cast<double>().lazyProduct(x->segment<6>(6 * A.column[k]));
      x->segment<6>(6 * i).noalias() -= inverse[i] * sum;
    }
  });
}

}  // namespace cupola
