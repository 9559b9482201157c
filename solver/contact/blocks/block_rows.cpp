#include "solver/contact/blocks/block_rows.hpp"

#include <algorithm>
#include <numeric>

#include "assembly/base/error.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

namespace {

constexpr double kOperationsPerEntry = 72.0;  // of a product with a vector
constexpr double kOperationsPerProduct =
    3000.0;  // of an entry of the left matrix with a row of the right one

/// Columns of row i of A B, ascending. `seen_in` marks the columns found so far by the number of the row.
template <class Left, class Right>
void columns_of_product(const BlockRowsOf<Left>& A, const BlockRowsOf<Right>& B, int i,
                        std::vector<int>* seen_in, std::vector<int>* columns) {
  columns->clear();
  for (int k = A.start[i]; k < A.start[i + 1]; ++k) {
    const int row = A.column[k];
    for (int q = B.start[row]; q < B.start[row + 1]; ++q) {
      int& seen = (*seen_in)[B.column[q]];
      if (seen == i) continue;
      seen = i;
      columns->push_back(B.column[q]);
    }
  }
  std::sort(columns->begin(), columns->end());
}

/// A B without values.
template <class Left, class Right>
BlockRows pattern_of_product(const BlockRowsOf<Left>& A, const BlockRowsOf<Right>& B) {
  CUPOLA_ASSERT(A.num_columns == B.num_rows());
  const double work = kOperationsPerProduct * static_cast<double>(A.column.size());
  BlockRows C;
  C.num_columns = B.num_columns;
  C.start.assign(A.num_rows() + 1, 0);
  const auto for_each_row = [&](const auto& action) {
    share_range(work, A.num_rows(), [&](int first, int last) {
      std::vector<int> seen_in(B.num_columns, -1), columns;
      for (int i = first; i < last; ++i) {
        columns_of_product(A, B, i, &seen_in, &columns);
        action(i, columns);
      }
    });
  };
  for_each_row(
      [&](int i, const std::vector<int>& columns) { C.start[i + 1] = static_cast<int>(columns.size()); });
  std::partial_sum(C.start.begin(), C.start.end(), C.start.begin());
  C.column.resize(C.start.back());
  for_each_row([&](int i, const std::vector<int>& columns) {
    std::copy(columns.begin(), columns.end(), C.column.begin() + C.start[i]);
  });
  return C;
}

/// Row i of A B, of which `C` is the pattern. `entry`: work array (num_columns).
template <class Right>
void multiply_row(const BlockRows& A, const BlockRowsOf<Right>& B, int i, const BlockRows& C, Mat6* row_of_C,
                  std::vector<int>* entry) {
  for (int k = C.start[i]; k < C.start[i + 1]; ++k) {
    (*entry)[C.column[k]] = k - C.start[i];
    row_of_C[k - C.start[i]].setZero();
  }
  for (int k = A.start[i]; k < A.start[i + 1]; ++k) {
    const int row = A.column[k];
    for (int q = B.start[row]; q < B.start[row + 1]; ++q) {
      const Mat6 right = B.value[q].template cast<double>();
      row_of_C[(*entry)[B.column[q]]] += A.value[k].lazyProduct(right);
    }
  }
}

template <class Scalar>
VecX product(const BlockRowsOf<Scalar>& A, const VecX& x) {
  CUPOLA_ASSERT(x.size() == 6 * A.num_columns);
  VecX y(6 * A.num_rows());
  share_range(kOperationsPerEntry * static_cast<double>(A.value.size()), A.num_rows(),
              [&](int first, int last) {
                for (int i = first; i < last; ++i) {
                  Vec6 sum = Vec6::Zero();
                  for (int k = A.start[i]; k < A.start[i + 1]; ++k)
                    sum.noalias() += A.value[k].template cast<double>() * x.segment<6>(6 * A.column[k]);
                  y.segment<6>(6 * i) = sum;
                }
              });
  return y;
}

}  // namespace

BlockRows both_triangles(const BlockPattern& pattern, const BlockMatrix& matrix) {
  const int n = pattern.num_blocks();
  CUPOLA_ASSERT(std::ssize(matrix.diagonal) == n && std::ssize(matrix.lower) == pattern.num_pairs());
  BlockRows A;
  A.num_columns = n;
  A.start.assign(n + 1, 0);
  for (int column = 0; column < n; ++column) {
    A.start[column + 1] += 1 + pattern.column_start[column + 1] - pattern.column_start[column];
    for (int p = pattern.column_start[column]; p < pattern.column_start[column + 1]; ++p)
      ++A.start[pattern.row[p] + 1];
  }
  std::partial_sum(A.start.begin(), A.start.end(), A.start.begin());
  A.column.resize(A.start.back());
  A.value.resize(A.start.back());
  std::vector<int> next(A.start.begin(), A.start.end() - 1), source(A.column.size());
  const auto put = [&](int row, int column, int from) {
    A.column[next[row]] = column;
    source[next[row]++] = from;
  };
  for (int column = 0; column < n; ++column) {  // ascending, so entries left of a diagonal precede it
    put(column, column, 0);
    for (int p = pattern.column_start[column]; p < pattern.column_start[column + 1]; ++p) {
      put(column, pattern.row[p], -(p + 1));
      put(pattern.row[p], column, p + 1);
    }
  }
  const auto count = static_cast<int>(source.size());
  share_range(kOperationsPerEntry * count, count, [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      const int from = source[k];
      if (from == 0)
        A.value[k] = matrix.diagonal[A.column[k]];
      else if (from > 0)
        A.value[k] = matrix.lower[from - 1];
      else
        A.value[k] = matrix.lower[-from - 1].transpose();
    }
  });
  return A;
}

VecX multiply(const BlockRows& A, const VecX& x) {
  return product(A, x);
}

VecX multiply(const SingleBlockRows& A, const VecX& x) {
  return product(A, x);
}

BlockRows multiply(const BlockRows& A, const BlockRows& B) {
  BlockRows C = pattern_of_product(A, B);
  C.value.resize(C.column.size());
  share_range(kOperationsPerProduct * static_cast<double>(A.value.size()), A.num_rows(),
              [&](int first, int last) {
                std::vector<int> entry(B.num_columns);
                for (int i = first; i < last; ++i)
                  multiply_row(A, B, i, C, C.value.data() + C.start[i], &entry);
              });
  return C;
}

BlockRows galerkin_product(const BlockRows& A, const SingleBlockRows& P,
                           const SingleBlockRows& P_transposed) {
  constexpr int kRowsAtOnce = 4096;
  const BlockRows AP = pattern_of_product(A, P);
  BlockRows C = pattern_of_product(P_transposed, AP);
  C.value.assign(C.column.size(), Mat6::Zero());
  std::vector<Mat6> rows;  // of A P
  for (int start = 0; start < A.num_rows(); start += kRowsAtOnce) {
    const int end = std::min(start + kRowsAtOnce, A.num_rows());
    const auto row_of_AP = [&](int i) { return rows.data() + AP.start[i] - AP.start[start]; };
    rows.resize(std::max<std::size_t>(rows.size(), AP.start[end] - AP.start[start]));
    const double work = kOperationsPerProduct * (A.start[end] - A.start[start]);
    share_range(work, end - start, [&](int first, int last) {
      std::vector<int> entry(P.num_columns);
      for (int i = start + first; i < start + last; ++i) multiply_row(A, P, i, AP, row_of_AP(i), &entry);
    });
    share_sums(work, C.num_rows(), [&](int first, int last) {
      for (int i = start; i < end; ++i) {
        for (int k = P.start[i]; k < P.start[i + 1]; ++k) {
          const int coarse = P.column[k];
          if (coarse < first || coarse >= last) continue;
          const Mat6 left = P.value[k].transpose().cast<double>();
          int at = C.start[coarse];
          for (int q = AP.start[i]; q < AP.start[i + 1]; ++q) {  // both rows have ascending columns
            while (C.column[at] != AP.column[q]) ++at;
            C.value[at] += left.lazyProduct(row_of_AP(i)[q - AP.start[i]]);
          }
        }
      }
    });
  }
  return C;
}

SingleBlockRows transpose(const SingleBlockRows& A) {
  SingleBlockRows T;
  T.num_columns = A.num_rows();
  T.start.assign(A.num_columns + 1, 0);
  for (const int column : A.column) ++T.start[column + 1];
  std::partial_sum(T.start.begin(), T.start.end(), T.start.begin());
  T.column.resize(A.column.size());
  T.value.resize(A.value.size());
  std::vector<int> next(T.start.begin(), T.start.end() - 1), source(A.value.size());
  for (int i = 0; i < A.num_rows(); ++i) {
    for (int k = A.start[i]; k < A.start[i + 1]; ++k) {
      const int at = next[A.column[k]]++;
      T.column[at] = i;
      source[at] = k;
    }
  }
  const auto count = static_cast<int>(source.size());
  share_range(kOperationsPerEntry * count, count, [&](int first, int last) {
    for (int at = first; at < last; ++at) T.value[at] = A.value[source[at]].transpose();
  });
  return T;
}

SingleBlockRows in_single_precision(const BlockRows& A) {
  SingleBlockRows S{A.start, A.column, {}, A.num_columns};
  S.value.resize(A.value.size());
  const auto count = static_cast<int>(A.value.size());
  share_range(kOperationsPerEntry * count, count, [&](int first, int last) {
    for (int k = first; k < last; ++k) S.value[k] = A.value[k].cast<float>();
  });
  return S;
}

}  // namespace cupola
