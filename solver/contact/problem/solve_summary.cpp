#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

Accuracy accuracy_in(ErrorMeasure measure) {
  switch (measure) {
    case ErrorMeasure::momentum:
      return {"momentum balance of the blocks",
              "largest unbalanced impulse of a block, relative to the mean block weight times the step"};
    case ErrorMeasure::contact_law:
      return {"contact law",
              "distance of the impulses from those that satisfy the law, relative to their norm"};
    case ErrorMeasure::all_residuals:
      return {
          "momentum balance and contact law",
          "larger of the momentum residual and the contact-law residual; at rigid contacts also the speed "
          "by which they violate the law, relative to that of a free fall over the step"};
    case ErrorMeasure::force_error:
      break;
  }
  return {
      "contact forces of a step",
      "bound of the distance from the exact solution of the step, in the norm of the compliance, relative "
      "to the forces"};
}

void SolveSummary::add_work(const SolveSummary& other) {
  iterations += other.iterations;
  factorizations += other.factorizations;
  conjugate_gradients += other.conjugate_gradients;
  line_search_evaluations += other.line_search_evaluations;
}

SolveSummary SolveSummary::after(const SolveSummary& earlier) const {
  SolveSummary both = *this;
  both.add_work(earlier);
  both.residual_history.insert(both.residual_history.begin(), earlier.residual_history.begin(),
                               earlier.residual_history.end());
  return both;
}

}  // namespace cupola
