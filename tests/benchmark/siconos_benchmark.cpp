// Comparison with Siconos (Debian packages, C API) on the same problems in one run, as CSV: the circular
// dome, 1,280 blocks, Coulomb's law, static-elastic and rigid. CPU seconds of one thread
// (OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1), of the solver call only for all solvers.
//
// Masses and speeds are scaled by their means, so that the error measure of Siconos, which mixes N s and m/s,
// is dimensionless. `error` is that measure, computed by the routine of Siconos for every solution. `force`
// is the relative difference of the impulses from our solution at 1e-11 (meaningful where the forces are
// unique).
//
// Each method of Siconos runs with several settings that its headers offer; the row shows the fastest that
// met the tolerance, or else the one with the smallest error. Each run has its own process, which is stopped
// at the limit of CPU seconds or at 16 GB. A method writes its result when it returns, so that a run that was
// stopped, or that its linear solver ended, has no error: its buffer was never filled.
//
//   siconos_benchmark [tolerance] [CPU seconds per run] [static|rigid]     1e-8, 120, both

#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" {
#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <GlobalFrictionContactProblem.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <NumericsSparseMatrix.h>
#include <SolverOptions.h>
#include <SparseBlockMatrix.h>
#include <fc3d_compute_error.h>
}

#include "assembly/base/process.hpp"
#include "assembly/program/program.hpp"
#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/runtime/blas_kernels.hpp"
#include "tests/arguments.hpp"
#include "tests/benchmark/dome_problem.hpp"
#include "tests/reference/delassus.hpp"

namespace cupola {
namespace {

constexpr double kGravity = 9.81;
constexpr int kUnlimited = 1'000'000;  // iterations; methods are limited by CPU time instead

NumericsMatrix* to_numerics(const Eigen::SparseMatrix<double>& A) {
  NumericsMatrix* matrix = NM_create(NM_SPARSE, static_cast<int>(A.rows()), static_cast<int>(A.cols()));
  NM_triplet_alloc(matrix, A.nonZeros());
  matrix->matrix2->origin = NSM_TRIPLET;
  for (int column = 0; column < A.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, column); it; ++it) {
      NM_entry(matrix, static_cast<int>(it.row()), static_cast<int>(it.col()), it.value());
    }
  }
  return matrix;
}

/// The problem scaled to mean mass 1 and reference speed 1.
ContactProblem scaled(const ContactProblem& problem, double mass, double speed) {
  ContactProblem p = problem;
  for (Mat6& M : p.M) M /= mass;
  p.E *= mass;
  p.b /= speed;
  p.v_star /= speed;
  return p;
}

/// Zero-initialised memory that a child process shares with its parent.
double* shared_zeros(std::size_t n) {
  void* memory = mmap(nullptr, n * sizeof(double), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return static_cast<double*>(memory);
}

/// Runs `work` in a child process limited to `seconds` of CPU time and 16 GB.
void run_capped(double seconds, const std::function<void()>& work) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const auto limit = [](auto resource, double most) {
      const rlimit both{static_cast<rlim_t>(most), static_cast<rlim_t>(most)};
      setrlimit(resource, &both);
    };
    limit(RLIMIT_CPU, seconds);
    limit(RLIMIT_AS, 16e9);
    limit(RLIMIT_CORE, 0);
    work();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
}

/// Options of a Siconos solver that differ from its defaults: index in iparam and value.
struct Settings {
  std::string name;
  std::vector<std::pair<int, int>> iparam;
};

/// A run that returned.
struct SiconosRun {
  std::string settings;
  double cpu = 0.0;
  int iterations = 0;
  double error = 0.0;
  VecX gamma;
};

SolverOptions* make_options(double tolerance, int solver, const Settings& settings) {
  SolverOptions* options = solver_options_create(solver);
  options->dparam[SICONOS_DPARAM_TOL] = tolerance;
  options->iparam[SICONOS_IPARAM_MAX_ITER] = kUnlimited;
  for (const auto& [index, value] : settings.iparam) options->iparam[index] = value;
  return options;
}

class Comparison {
 public:
  Comparison(std::string name, const ContactProblem& problem, double tolerance, double cap)
      : name_(std::move(name)),
        problem_(problem),
        local_(make_delassus(problem)),
        tolerance_(tolerance),
        cap_(cap) {
    W_ = to_numerics(local_.W);
    fc_ =
        frictionContactProblem_new_with_data(3, local_.num_contacts(), W_, local_.q.data(), local_.mu.data());
    impulses_ = shared_zeros(local_.q.size());
    spent_ = shared_zeros(3);
  }
  void run_cupola();
  void run_siconos_local(const std::string& solver_name, int solver, bool blocks,
                         const std::vector<Settings>& settings);
  void run_siconos_global(const std::vector<Settings>& settings);

 private:
  double siconos_error(VecX gamma) {
    VecX u = local_.W * gamma + local_.q;
    double error = 0.0;
    SolverOptions* options = solver_options_create(SICONOS_FRICTION_3D_NSGS);
    fc3d_compute_error(fc_, gamma.data(), u.data(), tolerance_, options, local_.q.norm(), &error);
    solver_options_delete(options);
    return error;
  }
  double force_difference(const VecX& gamma) const { return (gamma - reference_).norm() / reference_.norm(); }
  void print(const std::string& solver, const std::string& rest) {
    fmt::print("\"{}\",{:.0e},{},{}\n", name_, tolerance_, solver, rest);
    std::fflush(stdout);
  }
  void print(const std::string& solver, const SiconosRun& run) {
    print(solver, fmt::format("{},{:.2f},{},{:.1e},{:.1e},{:.1f}", run.settings, run.cpu, run.iterations,
                              run.error, force_difference(run.gamma), run.cpu / cupola_cpu_));
  }
  /// Runs `solve`, which fills impulses_ and returns its number of iterations; none if it was stopped.
  std::optional<SiconosRun> run_siconos(const Settings& settings, const std::function<int()>& solve);
  /// Prints the best of the runs of a solver.
  void print_best(const std::string& solver, const std::vector<SiconosRun>& runs, size_t tried);

  std::string name_;
  ContactProblem problem_;
  DelassusProblem local_;
  double tolerance_;
  double cap_;  ///< CPU s
  NumericsMatrix* W_ = nullptr;
  FrictionContactProblem* fc_ = nullptr;
  double* impulses_ = nullptr;  ///< of the Siconos method (3 nc)
  double* spent_ = nullptr;     ///< CPU s, iterations, 1 once the method has returned
  VecX reference_;
  double cupola_cpu_ = 1.0;
};

void Comparison::run_cupola() {
  ContactSolverOptions options;
  options.reference_speed = 1.0;
  options.law = FrictionLaw::coulomb;
  options.tolerance = 1e-11;
  ContactSolution x;
  solve_contact(problem_, options, &x);
  reference_ = x.gamma;
  // Our residuals differ from the error measure of Siconos: lower the tolerance until that measure meets it
  // too.
  for (options.tolerance = tolerance_; options.tolerance > 1e-12; options.tolerance *= 0.1) {
    x = {};
    const double start = cpu_seconds();
    const SolveSummary summary = solve_contact(problem_, options, &x);
    cupola_cpu_ = cpu_seconds() - start;
    const double error = siconos_error(x.gamma);
    if (error > tolerance_ && options.tolerance > 1e-11) continue;
    print("cupola newton", {"default", cupola_cpu_, summary.iterations, error, x.gamma});
    return;
  }
}

std::optional<SiconosRun> Comparison::run_siconos(const Settings& settings,
                                                  const std::function<int()>& solve) {
  Eigen::Map<VecX> gamma(impulses_, local_.q.size());
  gamma.setZero();
  spent_[2] = 0.0;
  run_capped(cap_, [&] {
    const double start = cpu_seconds();
    spent_[1] = solve();
    spent_[0] = cpu_seconds() - start;
    spent_[2] = 1.0;
  });
  // Not the exit code: MUMPS ends the process with code 0 after its own errors.
  if (spent_[2] != 1.0) return std::nullopt;
  return SiconosRun{settings.name, spent_[0], static_cast<int>(spent_[1]), siconos_error(gamma), gamma};
}

void Comparison::print_best(const std::string& solver, const std::vector<SiconosRun>& runs, size_t tried) {
  const SiconosRun* best = nullptr;
  // The routine that computes the error and the stopping tests of the solvers differ by rounding and scaling.
  const auto met = [this](const SiconosRun& run) { return run.error <= 2.0 * tolerance_; };
  for (const SiconosRun& run : runs)
    if (!best || met(run) > met(*best) ||
        (met(run) == met(*best) && (met(run) ? run.cpu < best->cpu : run.error < best->error)))
      best = &run;
  if (best)
    print(solver, *best);
  else
    print(solver, fmt::format("none of {} settings returned,> {:.0f},,none,none,> {:.0f}", tried, cap_,
                              cap_ / cupola_cpu_));
}

void Comparison::run_siconos_local(const std::string& solver_name, int solver, bool blocks,
                                   const std::vector<Settings>& settings) {
  FrictionContactProblem problem = *fc_;
  if (blocks) {
    SparseBlockStructuredMatrix* sbm = SBM_new();
    SBM_from_csparse(3, NM_csc(W_), sbm);
    problem.M = NM_new_SBM(static_cast<int>(local_.W.rows()), static_cast<int>(local_.W.cols()), sbm);
  }
  std::vector<SiconosRun> runs;
  for (const Settings& setting : settings) {
    const auto run = run_siconos(setting, [&] {
      SolverOptions* options = make_options(tolerance_, solver, setting);
      VecX u = VecX::Zero(local_.q.size());
      fc3d_driver(&problem, impulses_, u.data(), options);
      return options->iparam[SICONOS_IPARAM_ITER_DONE];
    });
    if (run) runs.push_back(*run);
  }
  print_best(solver_name, runs, settings.size());
}

/// The global formulation has no compliance: rigid problems only.
void Comparison::run_siconos_global(const std::vector<Settings>& settings) {
  std::vector<Eigen::Triplet<double>> mass, contacts;
  for (int k = 0; k < problem_.num_blocks(); ++k) {
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c < 6; ++c) {
        if (problem_.M[k](r, c) != 0.0) mass.emplace_back(6 * k + r, 6 * k + c, problem_.M[k](r, c));
      }
    }
  }
  const auto add = [&contacts](int i, int k, const Lever& lever) {
    const Mat63 D = lever.matrix();
    for (int r = 0; r < 6 && k != ContactProblem::kFixed; ++r) {
      for (int c = 0; c < 3; ++c) contacts.emplace_back(6 * k + r, 3 * i + c, D(r, c));
    }
  };
  for (int i = 0; i < problem_.num_contacts(); ++i) {
    add(i, problem_.block_a[i], problem_.D_a[i]);
    add(i, problem_.block_b[i], problem_.D_b[i]);
  }
  const int n = 6 * problem_.num_blocks(), m = 3 * problem_.num_contacts();
  Eigen::SparseMatrix<double> M(n, n), H(n, m);
  M.setFromTriplets(mass.begin(), mass.end());
  H.setFromTriplets(contacts.begin(), contacts.end());
  VecX q = M * problem_.v_star, b = problem_.b, mu = problem_.mu;
  GlobalFrictionContactProblem* global = globalFrictionContactProblem_new();
  global->dimension = 3;
  global->numberOfContacts = problem_.num_contacts();
  global->M = to_numerics(M);
  global->H = to_numerics(H);
  global->q = q.data();
  global->b = b.data();
  global->mu = mu.data();
  std::vector<SiconosRun> runs;
  for (const Settings& setting : settings) {
    const auto run = run_siconos(setting, [&] {
      SolverOptions* options = make_options(tolerance_, SICONOS_GLOBAL_FRICTION_3D_ADMM, setting);
      VecX u = VecX::Zero(m), v = VecX::Zero(n);
      gfc3d_driver(global, impulses_, u.data(), v.data(), options);
      return options->iparam[SICONOS_IPARAM_ITER_DONE];
    });
    if (run) runs.push_back(*run);
  }
  print_best("siconos global ADMM", runs, settings.size());
}

const std::vector<Settings>& admm_settings() {
  static const std::vector<Settings> all{
      {"default", {}},
      {"residual balancing",
       {{SICONOS_FRICTION_3D_ADMM_IPARAM_RHO_STRATEGY,
         SICONOS_FRICTION_3D_ADMM_RHO_STRATEGY_RESIDUAL_BALANCING}}},
      {"scaled residual balancing",
       {{SICONOS_FRICTION_3D_ADMM_IPARAM_RHO_STRATEGY,
         SICONOS_FRICTION_3D_ADMM_RHO_STRATEGY_SCALED_RESIDUAL_BALANCING}}},
      {"scaled residual balancing and eigenvalues",
       {{SICONOS_FRICTION_3D_ADMM_IPARAM_RHO_STRATEGY,
         SICONOS_FRICTION_3D_ADMM_RHO_STRATEGY_SCALED_RESIDUAL_BALANCING},
        {SICONOS_FRICTION_3D_ADMM_IPARAM_INITIAL_RHO, SICONOS_FRICTION_3D_ADMM_INITIAL_RHO_EIGENVALUES}}}};
  return all;
}

const std::vector<Settings>& nsgs_settings() {
  static const std::vector<Settings> all{
      {"default", {}},
      {"light error with full final",
       {{SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION,
         SICONOS_FRICTION_3D_NSGS_ERROR_EVALUATION_LIGHT_WITH_FULL_FINAL}}},
      {"light error with full final and shuffled",
       {{SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION,
         SICONOS_FRICTION_3D_NSGS_ERROR_EVALUATION_LIGHT_WITH_FULL_FINAL},
        {SICONOS_FRICTION_3D_NSGS_SHUFFLE, SICONOS_FRICTION_3D_NSGS_SHUFFLE_TRUE_EACH_LOOP}}}};
  return all;
}

const std::vector<Settings>& newton_settings() {
  static const std::vector<Settings> all{
      {"default", {}},
      {"no line search", {{SICONOS_FRICTION_3D_NSN_LINESEARCH, SICONOS_FRICTION_3D_NSN_LINESEARCH_NO}}},
      {"started by extragradient",
       {{SICONOS_FRICTION_3D_NSN_HYBRID_STRATEGY, SICONOS_FRICTION_3D_NSN_HYBRID_STRATEGY_VI_EG_NSN}}}};
  return all;
}

void compare(const std::string& name, const DomeProblem& dome, double tolerance, double cap) {
  const ContactProblem problem = make_problem(dome);
  const double mass = std::pow(root_mean_mass(problem), 2);
  Comparison comparison(name, scaled(problem, mass, kGravity * dome.h), tolerance, cap);
  comparison.run_cupola();
  if (dome.compliance == 0.0) comparison.run_siconos_global(admm_settings());
  comparison.run_siconos_local("siconos ADMM", SICONOS_FRICTION_3D_ADMM, false, admm_settings());
  comparison.run_siconos_local("siconos NSGS", SICONOS_FRICTION_3D_NSGS, true, nsgs_settings());
  comparison.run_siconos_local("siconos NSN Alart-Curnier", SICONOS_FRICTION_3D_NSN_AC, false,
                               newton_settings());
  comparison.run_siconos_local("siconos NSN Fischer-Burmeister", SICONOS_FRICTION_3D_NSN_FB, false,
                               newton_settings());
}

}  // namespace
}  // namespace cupola

int main(int argc, char** argv) {
  using namespace cupola;
  use_kernels_of_processor(argv);
  return run_program("siconos_benchmark", [&] {
    const std::string usage = "siconos_benchmark [tolerance] [CPU seconds per run] [static|rigid]";
    const std::vector<std::string> arguments = read_arguments(argc, argv, 0, 3, usage);
    const double tolerance = arguments.size() > 0 ? std::stod(arguments[0]) : 1e-8;
    const double cap = arguments.size() > 1 ? std::stod(arguments[1]) : 120.0;
    const std::string only = arguments.size() > 2 ? arguments[2] : "";
    if (!only.empty() && only != "static" && only != "rigid") throw InputError("usage: " + usage);
    DomeProblem dome;
    dome.slices_per_block = 2;
    dome.h = 1.0;
    fmt::print("problem,tolerance,solver,settings,CPU s,iterations,error,force,ratio\n");
    if (only != "rigid") compare("static-elastic dome, kappa 1e-8", dome, tolerance, cap);
    dome.h = 0.01;
    dome.compliance = 0.0;
    if (only != "static") compare("rigid dome, h = 0.01 s", dome, tolerance, cap);
    return ExitCode::done;
  });
}
