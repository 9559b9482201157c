#pragma once

#include <string>
#include <vector>

namespace cupola {

/// How a contact solve ended. Not converging is a result, not an exception.
enum class SolveEnding {
  converged,       ///< the stopping rule of the method was met
  max_iterations,  ///< the answer is the best iterate; its residuals say what it is worth
  stalled,         ///< no further decrease in double precision
  failed           ///< factorisation broke down or a value became infinite; the answer must not be used
};
std::string to_string(SolveEnding ending);

struct SolveSummary {
  SolveEnding ending = SolveEnding::failed;
  std::string message;  ///< the inequality that fired, with its numbers
  int iterations = 0;
  int passes = 0;  ///< outer passes of convex_passes.hpp; 0 where one convex solve sufficed
  int factorizations = 0;
  int conjugate_gradients = 0;  ///< inner iterations of lagged Newton steps
  int line_search_evaluations = 0;
  std::vector<double> residual_history;  ///< the method's own stopping measure per iteration
  double time_seconds = 0.0;
  bool usable() const { return ending != SolveEnding::failed; }
};

}  // namespace cupola
