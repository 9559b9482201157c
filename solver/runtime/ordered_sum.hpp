#pragma once

#include <type_traits>
#include <vector>

#include "solver/runtime/threads.hpp"

namespace cupola {

/// start + term(0) + ... + term(count - 1), added in this order: the same bits for any number of threads,
/// which compute the terms of their own ranges (share_sums(); a term must not throw). They may be of any type
/// with +=.
template <class Value, class Term>
Value sum_in_order(double work, int count, Value start, const Term& term) {
  if (num_threads() == 1) {
    for (int i = 0; i < count; ++i) start += term(i);
    return start;
  }
  std::vector<std::invoke_result_t<Term, int>> terms(static_cast<std::size_t>(count));
  share_sums(work, count, [&](int first, int last) {
    for (int i = first; i < last; ++i) terms[i] = term(i);
  });
  for (const auto& value : terms) start += value;
  return start;
}

}  // namespace cupola
