// Time and accuracy of the contact solvers, one table per call, as CSV. CPU seconds of one thread, except for
// threads. `make -f Makefile.cases benchmark` writes the tables into README.md.
//
//   contact_benchmark methods     a first step and two static solves by each method
//   contact_benchmark gaps        random gaps
//   contact_benchmark stepping    warm-started time steps
//   contact_benchmark motion      whole steps of domes in motion and at rest
//   contact_benchmark coulomb     rigid domes under Coulomb's law
//   contact_benchmark scale       1,280 to 20,480 blocks
//   contact_benchmark threads     assembly and factor on two threads, against CG

#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/program/program.hpp"
#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/blocks/multigrid.hpp"
#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/simulation.hpp"
#include "solver/runtime/blas_kernels.hpp"
#include "solver/runtime/threads.hpp"
#include "tests/arguments.hpp"
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

void print_header() {
  fmt::print("problem,method,ending,CPU s,iterations,momentum,law,certified,error\n");
}

void print_row(const std::string& name, ContactMethod method, const Run& r, const VecX& reference) {
  const double error = (r.x.gamma - reference).norm() / reference.norm();
  fmt::print(
      "\"{}\",{},{},{:.3f},{},{:.1e},{:.1e},{},{:.1e}\n", name, to_string(method),
      to_string(r.summary.ending), r.cpu, r.summary.iterations, r.residuals.momentum, r.residuals.contact_law,
      r.residuals.certificate.value ? fmt::format("{:.1e}", *r.residuals.certificate.value) : "none", error);
  std::fflush(stdout);
}

void compare_methods() {
  print_header();
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
  print_header();
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
  fmt::print("contacts,\"c, m/N\",tolerance,CPU ms per step,iterations,factorisations,worst residual\n");
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
    fmt::print("{},{:.0e},{:.0e},{:.1f},{:.2f},{},{:.1e}\n", problem.num_contacts(), c, tolerance,
               1e3 * cpu / 49, iterations / 49.0, factorizations, worst);
    std::fflush(stdout);
  }
}

/// A dome of 1,280 blocks, 20 steps of 0.01 s after the first 10.
struct DomeMotion {
  std::string name, bond;
  double friction, compliance, tolerance;  ///< compliance in m/N per point
  FrictionLaw law = FrictionLaw::associated;
};

struct StepCost {
  double cpu = 0.0, iterations = 0.0, factorizations = 0.0, worst = 0.0;
  double displacement = 0.0;  ///< m, largest
  int contacts = 0;
};

/// Mean cost of a step, from contact detection to the account of energy. `carried`: with the factor and the
/// impulses at rest that the solver keeps from step to step; the initial guess is the last step in any case.
StepCost measure_steps(const DomeMotion& dome, bool carried) {
  constexpr int kFirst = 10, kSteps = 20;
  Case scene = read_case(
      CUPOLA_SOURCE_DIR "/cases/dome_circular.yaml",
      {"geometry.bond=" + dome.bond, "analysis.type=dynamic",
       fmt::format("joints.friction={}", dome.friction), fmt::format("analysis.tolerance={}", dome.tolerance),
       fmt::format("analysis.friction_law={}", to_string(dome.law)),
       fmt::format("joints.compliance.normal={}", dome.compliance),
       fmt::format("joints.compliance.tangential={}", dome.compliance)});
  const Assembly assembly = cut_assembly(scene);
  SimulationOptions options = simulation_options(scene);
  options.solve.lag_factor = options.solve.try_rest = carried;
  Simulation simulation(make_model(scene, assembly), options);
  StepCost cost;
  for (int k = 0; k < kFirst + kSteps; ++k) {
    const double start = cpu_seconds();
    const StepReport report = simulation.advance();
    if (k < kFirst) continue;
    cost.cpu += (cpu_seconds() - start) / kSteps;
    cost.iterations += 1.0 * report.solve.iterations / kSteps;
    cost.factorizations += 1.0 * report.solve.factorizations / kSteps;
    cost.worst = std::max(cost.worst, largest_residual(report.residuals));
  }
  for (const Vec3& d : simulation.displacements()) cost.displacement = std::max(cost.displacement, d.norm());
  cost.contacts = static_cast<int>(simulation.contacts().points.size());
  return cost;
}

const std::string kRunning = "{type: running, rings: 40, blocks_per_ring: 32, slices_per_block: 4}";
const std::string kRunningOfTwo = "{type: running, rings: 40, blocks_per_ring: 32, slices_per_block: 2}";
const std::string kStack = "{type: stack, rings: 40, blocks_per_ring: 32, slices_per_block: 1}";

void whole_steps() {
  fmt::print(
      "scene,\"c, m/N\",contacts,tolerance,CPU ms per step,iterations,factorisations,worst residual,"
      "\"displacement, m\",nothing carried: ms,ratio\n");
  for (const DomeMotion& dome : {DomeMotion{"swinging, running bond", kRunning, 0.4, 1e-8, 1e-4},
                                 {"swinging, running bond", kRunning, 0.4, 1e-8, 1e-6},
                                 {"rigid, running bond", kRunning, 0.4, 0.0, 1e-6},
                                 {"rigid, stack bond", kStack, 0.4, 0.0, 1e-6},
                                 {"rigid, running bond, friction 0.05", kRunning, 0.05, 0.0, 1e-6}}) {
    const StepCost cost = measure_steps(dome, true), without = measure_steps(dome, false);
    fmt::print("\"{}\",{:g},{},{:g},{:.0f},{:.1f},{:.1f},{:.1e},{:.1e},{:.0f},{:.2f}\n", dome.name,
               dome.compliance, cost.contacts, dome.tolerance, 1e3 * cost.cpu, cost.iterations,
               cost.factorizations, cost.worst, cost.displacement, 1e3 * without.cpu, cost.cpu / without.cpu);
    std::fflush(stdout);
  }
}

/// Rigid domes under Coulomb's law: one step of 0.01 s from rest, scaled to mean mass 1 and reference speed
/// 1, and whole steps.
void coulomb() {
  fmt::print(
      "scene,contacts,tolerance,CPU ms,iterations,factorisations,worst residual,\"displacement, m\"\n");
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    DomeProblem dome;
    dome.slices_per_block = 2;
    dome.h = 0.01;
    dome.compliance = 0.0;
    const ContactProblem problem = make_problem(dome);
    ContactSolverOptions options = options_for(problem, ContactMethod::newton, tolerance);
    options.law = FrictionLaw::coulomb;
    const Run r = run(problem, options);
    fmt::print("first step from rest,{},{:g},{:.1f},{},{},{:.1e},\n", problem.num_contacts(), tolerance,
               1e3 * r.cpu, r.summary.iterations, r.summary.factorizations, largest_residual(r.residuals));
    std::fflush(stdout);
  }
  const FrictionLaw law = FrictionLaw::coulomb;
  for (const DomeMotion& dome :
       {DomeMotion{"at rest, stack bond", kStack, 0.4, 0.0, 1e-6, law},
        {"at rest, running bond", kRunningOfTwo, 0.4, 0.0, 1e-6, law},
        {"sliding at friction 0.05, stack bond", kStack, 0.05, 0.0, 1e-3, law},
        {"sliding at friction 0.05, running bond", kRunningOfTwo, 0.05, 0.0, 1e-3, law}}) {
    const StepCost cost = measure_steps(dome, true);
    fmt::print("\"{}\",{},{:g},{:.1f},{:.1f},{:.1f},{:.1e},{:.1e}\n", dome.name, cost.contacts,
               dome.tolerance, 1e3 * cost.cpu, cost.iterations, cost.factorizations, cost.worst,
               cost.displacement);
    std::fflush(stdout);
  }
}

/// Prints one row of the scale table and returns its CPU seconds.
double scale_row(const scenes::DomeShape& shape, int last_blocks, double last_cpu) {
  const ContactProblem problem = scenes::dome(shape, 1.0, {0.4, 1e-8, 1e-8});
  const Run r = run(problem, options_for(problem, ContactMethod::newton, 1e-8));
  const double exponent =
      last_blocks > 0 ? std::log(r.cpu / last_cpu) / std::log(1.0 * problem.num_blocks() / last_blocks) : 0.0;
  fmt::print("{},{},{},{:.2f},{:.2f},{:.1e},{}\n", problem.num_blocks(), problem.num_contacts(),
             r.summary.iterations, r.cpu, static_cast<double>(peak_memory_bytes()) / 1e9,
             r.residuals.momentum, last_blocks > 0 ? fmt::format("{:.2f}", exponent) : "");
  std::fflush(stdout);
  return r.cpu;
}

/// Spherical domes of the tests.
void scale() {
  fmt::print("blocks,contacts,iterations,CPU s,GB,momentum,exponent of the time\n");
  double cpu = 0.0;
  int blocks = 0;
  for (const int refine : {1, 2, 4}) {
    scenes::DomeShape shape;
    shape.rings = 40 * refine;
    shape.blocks_per_ring = 32 * refine;
    cpu = scale_row(shape, blocks, cpu);
    blocks = shape.rings * shape.blocks_per_ring;
  }
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
  fmt::print(
      "blocks,\"assembly, 1 thread\",\"assembly, 2 threads\",\"factor, 1 thread\",\"factor, 2 "
      "threads\",bits,solve,block Jacobi: CG iterations,block Jacobi: s,multigrid: set-up s,multigrid: CG "
      "iterations,multigrid: s\n");
  for (const int refine : {2, 4}) {
    scenes::DomeShape shape;
    shape.rings = 40 * refine;
    shape.blocks_per_ring = 32 * refine;
    const ContactProblem dome = scenes::dome(shape, 1.0, {0.4, 1e-8, 1e-8});
    const WhitenedProblem white = whiten(dome);
    const ContactGraph graph = contact_graph(dome);
    std::vector<Mat3> G;
    for (int i = 0; i < dome.num_contacts(); ++i)
      G.push_back(contact_stiffness(contact_law(dome, i), -Vec3::UnitX()));
    BlockMatrix H;
    double assembly[2], factorisation[2];
    VecX x[2];
    double solve = 0.0;
    for (const int n : {1, 2}) {
      set_num_threads(n);
      assembly[n - 1] = shortest([&] { H = assemble_hessian(white, graph, G); });
      BlockCholesky factor;
      if (!factor.factorize(graph.pattern, H)) return;  // the first factorisation includes the ordering
      bool sound = true;
      factorisation[n - 1] = shortest([&] { sound = factor.factorize(graph.pattern, H) && sound; });
      if (!sound) return;
      solve = shortest([&] { x[n - 1] = factor.solve(white.w_star); });
    }
    set_num_threads(1);
    const double start = wall_seconds();
    const int by_jacobi = block_jacobi_iterations(graph.pattern, H, white.w_star);
    const double jacobi = wall_seconds() - start;
    Multigrid multigrid;
    if (!multigrid.build(graph.pattern, H, rigid_motions(white, graph))) return;
    const double built = wall_seconds() - start - jacobi;
    const int by_multigrid = count_cg_iterations(graph.pattern, H, white.w_star,
                                                 [&](const VecX& r) { return multigrid.cycle(r); });
    fmt::print("{},{:.4f},{:.4f},{:.3f},{:.3f},{},{:.4f},{},{:.2f},{:.2f},{},{:.2f}\n", dome.num_blocks(),
               assembly[0], assembly[1], factorisation[0], factorisation[1],
               x[0] == x[1] ? "same" : "DIFFERENT", solve, by_jacobi, jacobi, built, by_multigrid,
               wall_seconds() - start - jacobi - built);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace cupola

int main(int argc, char** argv) {
  using namespace cupola;
  use_kernels_of_processor(argv);
  return run_program("contact_benchmark", [&] {
    const std::string usage =
        "contact_benchmark methods | gaps | stepping | motion | coulomb | scale | threads";
    const std::map<std::string, void (*)()> tables{{"methods", compare_methods}, {"gaps", random_gaps},
                                                   {"stepping", time_stepping},  {"motion", whole_steps},
                                                   {"coulomb", coulomb},         {"scale", scale},
                                                   {"threads", threads}};
    const auto table = tables.find(read_arguments(argc, argv, 1, 1, usage).front());
    if (table == tables.end()) throw InputError("usage: " + usage);
    table->second();
    return ExitCode::done;
  });
}
