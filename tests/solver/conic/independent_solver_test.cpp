// Least values of linear objectives over all admissible states, against cvxopt (Debian package
// python3-cvxopt).
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>
#include <unistd.h>

#include "assembly/files/number_text.hpp"
#include "tests/solver/conic/conic_scenes.hpp"

namespace cupola::independent_solver_test {
namespace {

const std::string kScript = CUPOLA_SOURCE_DIR "/tests/solver/conic/second_order_cone_programme.py";

/// A random objective that favours large forces, so that it has a least value.
ConicProblem random_problem(const ContactProblem& p, unsigned seed) {
  ConicProblem problem = scenes::conic(p);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (Eigen::Index i = 0; i < problem.cost.size(); ++i) problem.cost[i] = uniform(random);
  for (int i = 0; i < p.num_contacts(); ++i)
    problem.cost[3 * i] += 1.0 + p.mu[i] * problem.cost.segment<2>(3 * i + 1).norm();
  return problem;
}

/// The same with strength, random about the mean force of a contact; `sign` = -1 favours small forces.
ConicProblem random_strong_problem(const ContactProblem& p, unsigned seed, double sign) {
  ConicProblem problem = random_problem(p, seed);
  problem.cost *= sign;
  const double mean = problem.load.cwiseAbs().maxCoeff() / 4.0;
  std::mt19937 random(seed + 100);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  for (int i = 0; i < p.num_contacts(); ++i) {
    const double tension = mean * uniform(random), cohesion = mean * uniform(random);
    problem.contacts.strength.push_back({tension, cohesion, 20.0 * mean * (1.0 + uniform(random))});
  }
  return problem;
}

void write(const ConicProblem& problem, const std::string& file) {
  const ContactProblem& p = problem.contacts;
  std::ofstream out(file);
  const auto line = [&out](const auto& values) {
    for (const double value : values) out << format_number(value) << ' ';
    out << '\n';
  };
  out << p.num_blocks() << ' ' << p.num_contacts() << '\n';
  line(problem.load);
  line(problem.cost);
  line(p.mu);
  for (int i = 0; i < p.num_contacts(); ++i) {
    const ContactStrength strength = strength_at(problem, i, VecX());
    line(std::vector{strength.tension, strength.cohesion, strength.compression});
  }
  MatX D(problem.load.size(), problem.cost.size());
  for (Eigen::Index j = 0; j < D.cols(); ++j) D.col(j) = generalized_impulse(p, VecX::Unit(D.cols(), j));
  for (Eigen::Index k = 0; k < D.rows(); ++k) line(D.row(k));
}

double least_by_cvxopt(const ConicProblem& problem) {
  const std::string base =
      (std::filesystem::temp_directory_path() / ("cupola_cvxopt_" + std::to_string(::getpid()))).string();
  write(problem, base + ".in");
  const std::string command = "/usr/bin/python3 " + kScript + " < " + base + ".in > " + base + ".out";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::string status;
  double value = std::nan("");
  std::ifstream(base + ".out") >> status >> value;
  EXPECT_EQ(status, "optimal");
  std::filesystem::remove(base + ".in");
  std::filesystem::remove(base + ".out");
  return value;
}

std::vector<ContactProblem> models() {
  const scenes::Joint joint{};
  return {scenes::stack({1000, 2000, 500}, 0.01, joint), scenes::table(1000, 0.1, 0.2, 0.01, joint),
          scenes::arch(12, 0.2, 1.2, 0.0, 0.01, joint),
          scenes::dome({.rings = 4, .blocks_per_ring = 8}, 0.01, joint)};
}

void expect_same_value(const ConicProblem& problem) {
  const ConicSolution solution = solve_conic(problem);
  ASSERT_EQ(solution.outcome, ConicOutcome::optimal);
  EXPECT_NEAR(least_by_cvxopt(problem), solution.primal, 1e-6 * std::abs(solution.primal));
  EXPECT_LE(conic_bounds(problem, solution).relative_gap(), 1e-6);
}

/// Continuous integration sets CUPOLA_REQUIRE_PYTHON, so that the test runs there in any case.
bool has_cvxopt() {
  return std::getenv("CUPOLA_REQUIRE_PYTHON") != nullptr ||
         std::system("/usr/bin/python3 -c 'import cvxopt' 2> /dev/null") == 0;
}

// cvxopt is asked for 1e-8; at 1e-10 it breaks down on one of the models.
TEST(IndependentSolver, FindsTheSameLeastValues) {
  if (!has_cvxopt()) GTEST_SKIP() << "needs the package python3-cvxopt";
  for (const ContactProblem& model : models()) {
    SCOPED_TRACE(model.num_blocks());
    expect_same_value(random_problem(model, 1));
  }
}

TEST(IndependentSolverSlow, FindsTheSameLeastValuesOfMoreObjectives) {
  if (!has_cvxopt()) GTEST_SKIP() << "needs the package python3-cvxopt";
  for (const ContactProblem& model : models()) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(model.num_blocks());
      if (seed > 1) expect_same_value(random_problem(model, seed));
      for (const double sign : {1.0, -1.0}) expect_same_value(random_strong_problem(model, seed, sign));
    }
  }
}

}  // namespace
}  // namespace cupola::independent_solver_test
