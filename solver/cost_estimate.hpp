#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// One step of a motion that was computed for the estimate.
struct TimedStep {
  double h = 0.0;        ///< s
  int iterations = 0;    ///< of the contact method
  double seconds = 0.0;  ///< processor time
};

/// Estimated cost of a run.
struct CostEstimate {
  double seconds = 0.0;          ///< processor time of one thread, without reading and writing files; a lower
                                 ///< bound if something was left out
  double bytes = 0.0;            ///< peak memory
  std::string basis;             ///< what was timed
  std::string left_out;          ///< what did not end within the time limit; "" if the estimate is complete
  std::vector<TimedStep> steps;  ///< first steps of a motion, with the options of the run
  long long factor_entries = 0;  ///< of the Cholesky factor; 0 for methods without one
};

/// Times one factorisation (or multigrid solve) of `problem`, the first contact problem of the run; for a
/// dynamic analysis also its static start and its first steps, for a path its first equilibria instead. What
/// is not timed after `time_limit`, s, is left out.
CostEstimate estimate_cost(const Case& scene, const Assembly& assembly, const ContactProblem& problem,
                           double time_limit);

}  // namespace cupola
