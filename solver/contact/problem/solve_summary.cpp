#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

void SolveSummary::add_work(const SolveSummary& other) {
  iterations += other.iterations;
  factorizations += other.factorizations;
  conjugate_gradients += other.conjugate_gradients;
  line_search_evaluations += other.line_search_evaluations;
}

SolveSummary SolveSummary::after(const SolveSummary& earlier) const {
  SolveSummary both = *this;
  both.add_work(earlier);
  both.time_seconds += earlier.time_seconds;
  both.residual_history.insert(both.residual_history.begin(), earlier.residual_history.begin(),
                               earlier.residual_history.end());
  return both;
}

}  // namespace cupola
