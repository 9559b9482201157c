#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

std::string to_string(SolveEnding ending) {
  switch (ending) {
    case SolveEnding::converged:
      return "converged";
    case SolveEnding::max_iterations:
      return "max_iterations";
    case SolveEnding::stalled:
      return "stalled";
    case SolveEnding::failed:
      return "failed";
  }
  return "unknown";
}

}  // namespace cupola
