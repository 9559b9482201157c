#pragma once

#include <limits>
#include <string>
#include <vector>

#include "assembly/base/named_enum.hpp"
#include "assembly/model/accuracy.hpp"

namespace cupola {

/// How a contact solve ended. Not converging is a result, not an exception.
enum class SolveEnding {
  converged,       ///< the stopping rule of the method was met
  max_iterations,  ///< the solution is the best iterate; its residuals give its accuracy
  stalled,         ///< no further progress in double precision; the solution is the best iterate
  failed  ///< invalid input, breakdown of a factorisation or infinite values; the solution is invalid
};
constexpr auto enum_names(SolveEnding) {
  return std::array{"converged", "max_iterations", "stalled", "failed"};
}

/// What a stopping rule compares with the tolerance (residuals.hpp).
enum class ErrorMeasure {
  momentum,       ///< momentum residual
  contact_law,    ///< contact-law residual
  all_residuals,  ///< largest_residual()
  force_error     ///< force_error_bound() relative to the impulses, both in the norm of the compliance
};
constexpr auto enum_names(ErrorMeasure) {
  return std::array{"momentum residual", "contact-law residual", "largest residual", "force error bound"};
}
/// Quantity and norm of a measure, without values.
Accuracy accuracy_in(ErrorMeasure measure);

struct SolveSummary {
  SolveEnding ending = SolveEnding::failed;
  std::string message;                            ///< the criterion that ended the solve, with its numbers
  ErrorMeasure measure = ErrorMeasure::momentum;  ///< of the stopping rule
  double reached = std::numeric_limits<double>::quiet_NaN();  ///< that measure of the solution returned
  int iterations = 0;
  int outer_iterations = 0;  ///< of outer_iterations.hpp; 0 when one convex solve was enough
  int factorizations = 0;
  int conjugate_gradients = 0;  ///< CG iterations of Newton directions
  int line_search_evaluations = 0;
  std::vector<double> residual_history;  ///< measure of the method's stopping rule, per iteration
  bool usable() const { return ending != SolveEnding::failed; }

  /// Adds the counts of work of another solve: iterations, factorisations, conjugate gradients, evaluations.
  void add_work(const SolveSummary& other);
  /// This summary with the work, the time and the residual history of an earlier solve of the same problem.
  SolveSummary after(const SolveSummary& earlier) const;
};

}  // namespace cupola
