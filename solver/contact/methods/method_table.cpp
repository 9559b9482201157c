#include "solver/contact/methods/method_table.hpp"

#include <algorithm>
#include <array>

#include "assembly/base/error.hpp"
#include "solver/contact/methods/admm.hpp"
#include "solver/contact/methods/apgd.hpp"
#include "solver/contact/methods/interior_point.hpp"
#include "solver/contact/methods/nsgs.hpp"
#include "solver/contact/methods/spg.hpp"

namespace cupola {

namespace {

/// A method that keeps nothing between calls.
template <auto solve>
SolveSummary stateless(NewtonSolver&, const ContactProblem& problem, const SolveOptions& options,
                       ContactSolution* solution) {
  return solve(problem, options, solution);
}

// clang-format off
constexpr std::array<MethodTraits, 6> kMethodTable{{
    // method                       primal  factor multigrid  solve
    {ContactMethod::newton,         true,   true,  true,      solve_newton_with_fallback},
    {ContactMethod::interior_point, true,   true,  false,     solve_interior_point_then_newton},
    {ContactMethod::spg,            false,  false, false,     stateless<solve_spg>},
    {ContactMethod::apgd,           false,  false, false,     stateless<solve_apgd>},
    {ContactMethod::nsgs,           false,  false, false,     stateless<solve_nsgs>},
    {ContactMethod::admm,           false,  true,  false,     stateless<solve_admm>},
}};
// clang-format on
static_assert(kMethodTable.size() == enum_names(ContactMethod{}).size());

}  // namespace

const MethodTraits& method_traits(ContactMethod method) {
  const auto row = std::find_if(kMethodTable.begin(), kMethodTable.end(),
                                [&](const MethodTraits& traits) { return traits.method == method; });
  CUPOLA_ASSERT(row != kMethodTable.end());
  return *row;
}

SolveSummary solve_interior_point_then_newton(NewtonSolver& newton, const ContactProblem& problem,
                                              const SolveOptions& options, ContactSolution* solution) {
  constexpr double kHandOver = 1e-7;  // Newton then finds the last few active sets
  SolveOptions coarse = options;
  coarse.tolerance = kHandOver;
  coarse.max_iterations.reset();
  const SolveSummary first = solve_interior_point(problem, coarse, solution);
  if (!first.usable()) return first;
  SolveSummary last = newton.solve(problem, options, solution).after(first);
  last.message = "interior point, then Newton: " + last.message;
  return last;
}

SolveSummary solve_newton_with_fallback(NewtonSolver& newton, const ContactProblem& problem,
                                        const SolveOptions& options, ContactSolution* solution) {
  const int usual_iterations = usual_newton_iterations(problem);  // interior point takes about 27
  const int limit = options.max_iterations.value_or(kNewtonIterations);
  // The interior-point method knows cones, not strengths.
  if (!problem.strength.empty()) return newton.solve(problem, options, solution);
  SolveOptions plain = options;
  plain.max_iterations = std::min(limit, usual_iterations);
  const SolveSummary first = newton.solve(problem, plain, solution);
  if (first.ending != SolveEnding::max_iterations || limit <= usual_iterations) return first;
  ContactSolution again;
  SolveSummary last = solve_interior_point_then_newton(newton, problem, options, &again).after(first);
  if (!last.usable() || last.residual_history.back() > first.residual_history.back()) return first;
  *solution = again;
  return last;
}

}  // namespace cupola
