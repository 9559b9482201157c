#include "solver/fclib/solve_fclib.hpp"

#include <fmt/format.h>

#include "solver/contact/methods/delassus_newton.hpp"
#include "solver/fclib/fclib_file.hpp"

namespace cupola {

ExitCode solve_fclib(const std::string& path, const std::string& output, bool quiet) {
  const FclibProblem file = read_fclib(path);
  const DelassusProblem& problem = file.local;
  VecX gamma;
  const SolveSummary summary = solve_delassus(problem, DelassusOptions{}, &gamma);
  if (!output.empty()) write_fclib(output, "solution of " + path, problem, gamma);
  const bool converged = summary.ending == SolveEnding::converged;
  if (!quiet || !converged) {
    fmt::print("{}: {}\n", to_string(summary.ending), summary.message);
    fmt::print("  {} contacts, {} form; Coulomb's law, method newton on the local form\n",
               problem.num_contacts(), file.was_global ? "global" : "local");
    fmt::print("  FCLIB merit {:.2e}, scaled residual {:.2e}\n",
               fclib_merit(problem, gamma, FrictionLaw::coulomb),
               scaled_merit(problem, gamma, FrictionLaw::coulomb));
    if (file.impulses) {
      fmt::print("  the file's own solution has FCLIB merit {:.2e}\n",
                 fclib_merit(problem, *file.impulses, FrictionLaw::coulomb));
    }
    fmt::print("  {} outer iterations, {} iterations, {:.3f} s\n", summary.outer_iterations,
               summary.iterations, summary.time_seconds);
  }
  return converged ? ExitCode::done : ExitCode::accuracy_not_reached;
}

}  // namespace cupola
