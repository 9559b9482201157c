#include "solver/fclib/solve_fclib.hpp"

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
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
    fmt::print("  {}, {} form; Coulomb's law, method newton on the local form\n",
               counted(problem.num_contacts(), "contact"), file.was_global ? "global" : "local");
    fmt::print("  FCLIB merit {:.2e}, scaled residual {:.2e}\n",
               fclib_merit(problem, gamma, FrictionLaw::coulomb),
               scaled_merit(problem, gamma, FrictionLaw::coulomb));
    if (file.impulses) {
      fmt::print("  the file's own solution has FCLIB merit {:.2e}\n",
                 fclib_merit(problem, *file.impulses, FrictionLaw::coulomb));
    }
    fmt::print("  {}, {}, {:.3f} s\n", counted(summary.outer_iterations, "outer iteration"),
               counted(summary.iterations, "iteration"), summary.time_seconds);
  }
  return converged ? ExitCode::done : ExitCode::accuracy_not_reached;
}

}  // namespace cupola
