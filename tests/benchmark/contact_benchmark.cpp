// What the contact solvers cost and reach, as tables: methods on one static solve and on the first step,
// random gaps, time stepping, scale. CPU seconds, one thread.
//
//   contact_benchmark                                    all but the two largest sizes
//   contact_benchmark methods | gaps | stepping | scale  one table
//   contact_benchmark large                              scale to 81,920 and 327,680 blocks (12 GB)

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "assembly/program.hpp"
#include "solver/contact/residuals.hpp"
#include "solver/contact/solve_contact.hpp"
#include "tests/benchmark/dome_problem.hpp"
#include "tests/solver/contact_scenes.hpp"

namespace cupola {
namespace {

constexpr double kGravity = 9.81;

ContactSolverOptions options_for(const ContactProblem& problem, ContactMethod method, double tolerance) {
  ContactSolverOptions options;
  options.method = method;
  options.tolerance = tolerance;
  options.reference_speed = kGravity * problem.h;
  return options;
}

struct Run {
  ContactSolution x;
  SolveSummary summary;
  Residuals residuals;
  double cpu = 0.0;
};

Run run(const ContactProblem& problem, const ContactSolverOptions& options) {
  Run result;
  const double start = cpu_seconds();
  result.summary = solve_contact(problem, options, &result.x);
  result.cpu = cpu_seconds() - start;
  result.residuals = compute_residuals(problem, result.x, options.reference_speed, options.law);
  return result;
}

void print_header(const char* title) {
  fmt::print("\n{}\n{:<28} {:<15} {:<15} {:>8} {:>6} {:>6} {:>9} {:>9} {:>10} {:>10}\n", title, "problem",
             "method", "ending", "CPU s", "iter", "fact", "momentum", "law", "certified", "error");
}

void print_row(const std::string& name, ContactMethod method, const Run& r, const VecX& reference) {
  const double error = (r.x.gamma - reference).norm() / reference.norm();
  fmt::print(
      "{:<28} {:<15} {:<15} {:>8.3f} {:>6} {:>6} {:>9.1e} {:>9.1e} {:>10} {:>10.1e}\n", name,
      to_string(method), to_string(r.summary.ending), r.cpu, r.summary.iterations, r.summary.factorizations,
      r.residuals.momentum, r.residuals.contact_law,
      r.residuals.certified_force_error ? fmt::format("{:.1e}", *r.residuals.certified_force_error) : "none",
      error);
  std::fflush(stdout);
}

void compare_methods() {
  print_header("Methods, tolerance 1e-8, error against Newton at 1e-12");
  for (const auto& [name, h] : {std::pair{"first step, kappa 1e-4", 0.01},
                                {"static, kappa 1e-8", 1.0},
                                {"static, kappa 1e-14", 1e3}}) {
    DomeProblem dome;
    dome.h = h;
    const ContactProblem problem = make_problem(dome);
    const Run reference = run(problem, options_for(problem, ContactMethod::newton, 1e-12));
    for (const ContactMethod method :
         {ContactMethod::newton, ContactMethod::interior_point, ContactMethod::admm, ContactMethod::spg,
          ContactMethod::apgd, ContactMethod::nsgs}) {
      ContactSolverOptions options = options_for(problem, method, 1e-8);
      if (method == ContactMethod::nsgs) options.max_iterations = 500;
      if (method == ContactMethod::spg || method == ContactMethod::apgd) options.max_iterations = 1000;
      print_row(name, method, run(problem, options), reference.x.gamma);
    }
  }
}

void random_gaps() {
  print_header("Random gaps, static h = 1 s, newton with fall-back, tolerance 1e-8, error against 1e-11");
  for (const double gap : {1e-4, 1e-2}) {
    for (const double c : {1e-8, 1e-10, 1e-12}) {
      DomeProblem dome;
      dome.h = 1.0;
      dome.compliance = c;
      dome.gap = gap;
      const ContactProblem problem = make_problem(dome);
      const Run reference = run(problem, options_for(problem, ContactMethod::interior_point, 1e-11));
      print_row(fmt::format("gap {:.0e} m, c {:.0e} m/N", gap, c), ContactMethod::newton,
                run(problem, options_for(problem, ContactMethod::newton, 1e-8)), reference.x.gamma);
    }
  }
}

/// Steps with memory springs on frozen geometry; the mean over steps 2 to 50.
void time_stepping() {
  fmt::print("\nTime stepping, h = 0.01 s, memory, lagged factor, mean of steps 2 to 50\n");
  fmt::print("{:<12} {:<10} {:>9} {:>12} {:>10} {:>8} {:>10}\n", "c m/N", "tolerance", "contacts",
             "CPU ms/step", "iterations", "fact", "worst");
  for (const auto& [slices, c, tolerance] :
       {std::tuple{2, 1e-8, 1e-4}, {2, 1e-8, 1e-8}, {2, 1e-10, 1e-6}, {4, 1e-8, 1e-4}, {4, 1e-8, 1e-8}}) {
    DomeProblem dome;
    dome.slices_per_block = slices;
    dome.h = 0.01;
    dome.compliance = c;
    ContactProblem problem = make_problem(dome);
    const VecX fall = problem.v_star;
    ContactSolver solver;
    ContactSolverOptions options = options_for(problem, ContactMethod::newton, tolerance);
    options.lag_factor = true;
    ContactSolution x;
    double cpu = 0.0, worst = 0.0;
    int iterations = 0, factorizations = 0;
    for (int step = 1; step <= 50; ++step) {
      const double start = cpu_seconds();
      const SolveSummary summary = solver.solve(problem, options, &x);
      if (step > 1) {
        cpu += cpu_seconds() - start;
        iterations += summary.iterations;
        factorizations += summary.factorizations;
      }
      worst = std::max(worst, compute_residuals(problem, x, options.reference_speed).momentum);
      const VecX u = relative_velocity(problem, x.v);
      for (int i = 0; i < problem.num_contacts(); ++i) {
        problem.b[3 * i] += u[3 * i];
        for (int t = 1; t < 3; ++t) problem.b[3 * i + t] = -problem.E[3 * i + t] * x.gamma[3 * i + t];
      }
      problem.v_star = x.v + fall;
    }
    fmt::print("{:<12.0e} {:<10.0e} {:>9} {:>12.1f} {:>10.2f} {:>8} {:>10.1e}\n", c, tolerance,
               problem.num_contacts(), 1e3 * cpu / 49, iterations / 49.0, factorizations, worst);
    std::fflush(stdout);
  }
}

/// Spherical domes of the tests, which need no generator at these sizes.
void scale(bool large) {
  fmt::print(
      "\nScale, static kappa 1e-8, newton, tolerance 1e-8\n{:>8} {:>9} {:>6} {:>9} {:>9} {:>9} {:>9}\n",
      "blocks", "contacts", "iter", "CPU s", "GB", "momentum", "exponent");
  double last_cpu = 0.0;
  int last_blocks = 0;
  for (const int refine : {1, 2, 4, 8, 16}) {
    if (refine > 4 && !large) break;
    scenes::DomeShape shape;
    shape.rings = 40 * refine;
    shape.blocks_per_ring = 32 * refine;
    const ContactProblem problem = scenes::dome(shape, 1.0, {0.4, 1e-8, 1e-8});
    const Run r = run(problem, options_for(problem, ContactMethod::newton, 1e-8));
    const double exponent =
        last_blocks > 0 ? std::log(r.cpu / last_cpu) / std::log(1.0 * problem.num_blocks() / last_blocks)
                        : 0.0;
    fmt::print("{:>8} {:>9} {:>6} {:>9.2f} {:>9.2f} {:>9.1e} {:>9.2f}\n", problem.num_blocks(),
               problem.num_contacts(), r.summary.iterations, r.cpu,
               static_cast<double>(peak_memory_bytes()) / 1e9, r.residuals.momentum, exponent);
    std::fflush(stdout);
    last_cpu = r.cpu;
    last_blocks = problem.num_blocks();
  }
}

}  // namespace
}  // namespace cupola

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  const auto asked = [&only](const char* part) { return only.empty() || only == part; };
  if (asked("methods")) cupola::compare_methods();
  if (asked("gaps")) cupola::random_gaps();
  if (asked("stepping")) cupola::time_stepping();
  if (asked("scale") || only == "large") cupola::scale(only == "large");
  return 0;
}
