// Time and accuracy of the contact solvers, as tables: methods on a first step and two static solves, random
// gaps, time stepping, threads and scale. CPU seconds of one thread, except for threads.
//
//   contact_benchmark                                    all tables, without the two largest sizes and million
//   contact_benchmark methods | gaps | stepping | scale  one table
//   contact_benchmark threads                            assembly and factor on two threads, against CG
//   contact_benchmark large                              scale up to 81,920 and 327,680 blocks (10 GB)
//   contact_benchmark million                            1,024,000 blocks by one of eight sectors

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/blocks/multigrid.hpp"
#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/runtime/threads.hpp"
#include "tests/benchmark/dome_problem.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

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
  fmt::print("{:<28} {:<15} {:<15} {:>8.3f} {:>6} {:>6} {:>9.1e} {:>9.1e} {:>10} {:>10.1e}\n", name,
             to_string(method), to_string(r.summary.ending), r.cpu, r.summary.iterations,
             r.summary.factorizations, r.residuals.momentum, r.residuals.contact_law,
             r.residuals.certificate.value ? fmt::format("{:.1e}", *r.residuals.certificate.value) : "none",
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
  print_header("Random gaps, static, h = 1 s, newton with fallback, tolerance 1e-8, error against 1e-11");
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

/// Time steps on frozen geometry with tangential springs that remember their slip; mean of steps 2 to 50.
void time_stepping() {
  fmt::print("\nTime stepping, h = 0.01 s, springs with memory, lagged factor, mean of steps 2 to 50\n");
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

/// Prints one row of the scale table and returns its CPU seconds.
double scale_row(const scenes::DomeShape& shape, int last_blocks, double last_cpu) {
  const ContactProblem problem = scenes::dome(shape, 1.0, {0.4, 1e-8, 1e-8});
  const Run r = run(problem, options_for(problem, ContactMethod::newton, 1e-8));
  const double exponent =
      last_blocks > 0 ? std::log(r.cpu / last_cpu) / std::log(1.0 * problem.num_blocks() / last_blocks) : 0.0;
  fmt::print("{:>8} {:>9} {:>6} {:>9.2f} {:>9.2f} {:>9.1e} {:>9.2f}\n", shape.sectors * problem.num_blocks(),
             shape.sectors * problem.num_contacts(), r.summary.iterations, r.cpu,
             static_cast<double>(peak_memory_bytes()) / 1e9, r.residuals.momentum, exponent);
  std::fflush(stdout);
  return r.cpu;
}

void print_scale_header(const char* what) {
  fmt::print(
      "\nScale, static kappa 1e-8, newton, tolerance 1e-8{}\n{:>8} {:>9} {:>6} {:>9} {:>9} {:>9} {:>9}\n",
      what, "blocks", "contacts", "iter", "CPU s", "GB", "momentum", "exponent");
}

/// Spherical domes of the tests: no generator is needed at these sizes.
void scale(bool large) {
  print_scale_header("");
  double cpu = 0.0;
  int blocks = 0;
  for (const int refine : {1, 2, 4, 8, 16}) {
    if (refine > 4 && !large) break;
    scenes::DomeShape shape;
    shape.rings = 40 * refine;
    shape.blocks_per_ring = 32 * refine;
    cpu = scale_row(shape, blocks, cpu);
    blocks = shape.rings * shape.blocks_per_ring;
  }
}

void million() {
  print_scale_header(", one sector of eight");
  scenes::DomeShape shape;
  shape.rings = 1000;
  shape.blocks_per_ring = 1024;
  shape.sectors = 8;
  scale_row(shape, 0, 0.0);
}

/// Shortest wall time of three runs, s.
template <class Work>
double shortest(const Work& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double start = wall_seconds();
    work();
    best = std::min(best, wall_seconds() - start);
  }
  return best;
}

/// Number of iterations of preconditioned conjugate gradients (CG) to a relative residual of 1e-8.
template <class Precondition>
int count_cg_iterations(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                        const Precondition& precondition) {
  constexpr int kMaxIterations = 20000;
  VecX x = VecX::Zero(rhs.size()), r = rhs, z = precondition(r), p = z;
  double rz = r.dot(z);
  int k = 0;
  for (; k < kMaxIterations && r.norm() > 1e-8 * rhs.norm(); ++k) {
    const VecX Hp = multiply(pattern, H, p);
    const double alpha = rz / p.dot(Hp);
    x += alpha * p;
    r -= alpha * Hp;
    z = precondition(r);
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
  }
  return k;
}

/// The same, preconditioned with the 6 x 6 diagonal blocks.
int block_jacobi_iterations(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs) {
  std::vector<Mat6> inverse;
  for (const Mat6& block : H.diagonal) inverse.push_back(block.inverse());
  return count_cg_iterations(pattern, H, rhs, [&](const VecX& r) {
    VecX z(r.size());
    for (int k = 0; k < pattern.num_blocks(); ++k)
      z.segment<6>(6 * k).noalias() = inverse[k] * r.segment<6>(6 * k);
    return z;
  });
}

/// The Hessian in which every contact sticks: assembly, factorisation and solve on one and two threads, and
/// the same system solved by CG on one thread.
void threads() {
  fmt::print("\nOne and two threads, wall s, shortest of three; CG with block Jacobi and with multigrid\n");
  fmt::print("{:>8} {:>10} {:>10} {:>8} {:>10} {:>10} {:>8} {:>5} {:>8} {:>8} {:>8} {:>8} {:>10} {:>8}\n",
             "blocks", "assembly 1", "2", "speed-up", "factor 1", "2", "speed-up", "bits", "solve", "Jacobi",
             "wall s", "set-up s", "multigrid", "wall s");
  for (const int refine : {2, 4, 8}) {
    scenes::DomeShape shape;
    shape.rings = 40 * refine;
    shape.blocks_per_ring = 32 * refine;
    const ContactProblem dome = scenes::dome(shape, 1.0, {0.4, 1e-8, 1e-8});
    const WhitenedProblem white = whiten(dome);
    const ContactProblem& p = white.problem;
    const ContactGraph graph = contact_graph(p);
    std::vector<Mat3> G;
    for (int i = 0; i < p.num_contacts(); ++i)
      G.push_back(contact_stiffness(contact_law(p, i), -Vec3::UnitX()));
    BlockMatrix H;
    double assembly[2], factorisation[2];
    VecX x[2];
    double solve = 0.0;
    for (const int n : {1, 2}) {
      set_num_threads(n);
      assembly[n - 1] = shortest([&] { H = assemble_hessian(p, graph, G); });
      BlockCholesky factor;
      if (!factor.factorize(graph.pattern, H)) return;  // the first factorisation includes the ordering
      bool sound = true;
      factorisation[n - 1] = shortest([&] { sound = factor.factorize(graph.pattern, H) && sound; });
      if (!sound) return;
      solve = shortest([&] { x[n - 1] = factor.solve(p.v_star); });
    }
    set_num_threads(1);
    const double start = wall_seconds();
    const int by_jacobi = block_jacobi_iterations(graph.pattern, H, p.v_star);
    const double jacobi = wall_seconds() - start;
    Multigrid multigrid;
    if (!multigrid.build(graph.pattern, H, rigid_motions(dome, graph, white.L))) return;
    const double built = wall_seconds() - start - jacobi;
    const int by_multigrid =
        count_cg_iterations(graph.pattern, H, p.v_star, [&](const VecX& r) { return multigrid.cycle(r); });
    fmt::print(
        "{:>8} {:>10.4f} {:>10.4f} {:>8.2f} {:>10.3f} {:>10.3f} {:>8.2f} {:>5} {:>8.4f} {:>8} {:>8.2f} "
        "{:>8.2f} {:>10} {:>8.2f}\n",
        p.num_blocks(), assembly[0], assembly[1], assembly[0] / assembly[1], factorisation[0],
        factorisation[1], factorisation[0] / factorisation[1], x[0] == x[1] ? "same" : "DIFFERENT", solve,
        by_jacobi, jacobi, built, by_multigrid, wall_seconds() - start - jacobi - built);
    std::fflush(stdout);
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
  if (asked("threads")) cupola::threads();
  if (only == "million") cupola::million();
  if (asked("scale") || only == "large") cupola::scale(only == "large");
  return 0;
}
