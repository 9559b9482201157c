// Joints with strength in conic problems: closed forms at every limit, and what proves that there is no
// state.
#include <limits>

#include "tests/solver/conic/conic_scenes.hpp"

namespace cupola::dry_problem_test {
namespace {

using scenes::conic;
using scenes::maximise_load;
using scenes::range;
using scenes::sideways;

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kAgrees = 1e-7;  // of a load; the solver asks for 1e-9 of the largest value of the problem

void strengthen(ConicProblem* problem, const ContactStrength& strength) {
  problem->contacts.strength.assign(problem->contacts.num_contacts(), strength);
}

/// The same with rows of motion in the plane x-z alone.
ConicProblem in_plane(ConicProblem problem) {
  problem.contacts.plane = true;
  for (auto* side : {&problem.contacts.D_a, &problem.contacts.D_b})
    for (Lever& D : *side) {
      D.frame.row(1).setZero();
      D.arm[1] = 0.0;
    }
  for (Eigen::Index k = 0; k < problem.load.size(); k += 6)
    for (const int row : {1, 3, 5}) problem.load[k + row] = 0.0;
  return problem;
}

/// Largest horizontal load over the weight W of a block of 1 x 1 x 0.2 m on four points at its corners: it
/// slides at mu W + 4 c, and tips when the rear points pull with 2 T or when the front points press with 2 F.
double exact_load(double mu, const ContactStrength& s, double weight) {
  const double slides = mu * weight + 4 * s.cohesion;
  const double pulls = (weight / 2 + 2 * std::min(s.tension, s.cohesion / mu)) / 0.1;
  const double crushes = (2 * s.compression - weight / 2) / 0.1;
  return std::min({slides, pulls, crushes}) / weight;
}

TEST(ConicStrength, HorizontalLoadSlidesTipsOrCrushes) {
  for (const bool plane : {false, true}) {
    for (const double mu : {0.3, 20.0}) {
      ConicProblem problem = conic(scenes::incline(0.0, 0.01, {.mu = mu}));
      if (plane) problem = in_plane(problem);
      const double W = -problem.load[2];
      for (const ContactStrength& s : std::vector<ContactStrength>{{0, 0.1 * W, kNone},
                                                                   {0.2 * W, 10 * W, kNone},
                                                                   {W, W, kNone},
                                                                   {0, 10 * W, 0.4 * W},
                                                                   {0.1 * W, 10 * W, 0.4 * W},
                                                                   {0.1 * W, 10 * W, 1e6 * W}}) {
        SCOPED_TRACE(::testing::Message()
                     << plane << " mu " << mu << " tension " << s.tension / W << " cohesion "
                     << s.cohesion / W << " compression " << s.compression / W);
        strengthen(&problem, s);
        maximise_load(&problem, sideways(problem));
        const double exact = exact_load(mu, s, W);
        const ConicSolution solution = solve_conic(problem);
        // Where it turns about points at their tension that friction holds in place, rounding may stop the
        // solve short of 1e-9; the bounds say what is proven.
        EXPECT_TRUE(solution.outcome == ConicOutcome::optimal || solution.outcome == ConicOutcome::stalled);
        EXPECT_NEAR(solution.multipliers[0], exact, kAgrees * exact);
        const ConicBounds bounds = conic_bounds(problem, solution);
        const bool hardest = !plane && mu == 20.0 && s.tension == 0.2 * W;  // stops at 4e-8
        EXPECT_NEAR(-bounds.lower, exact, (hardest ? 1e-4 : 1e-6) * exact);
        EXPECT_GE(-bounds.lower, exact * (1 - 1e-9)) << "a bound";
        // A solve that rounding stops short, which depends on the kernels of OpenBLAS, left 2e-7 with the
        // slowest ones.
        EXPECT_LE(bounds.cone_violation, solution.outcome == ConicOutcome::optimal ? kAgrees : 1e-6);
      }
    }
  }
}

// Without friction a contact that can pull carries any force above -T.
TEST(ConicStrength, BlockHangsFromItsTensileStrength) {
  scenes::Scene scene(0.01, {0, 0, -scenes::kGravity});
  const int block = scene.add_box({0, 0, -0.5}, {1, 1, 1}, 2000.0);
  scene.add_patch(block, scenes::kGround, {0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 1}, {.mu = 0.0});
  ConicProblem problem = conic(scene.problem());
  const double weight = 2000.0 * scenes::kGravity;
  strengthen(&problem, {0.26 * weight, 0.0, kNone});
  EXPECT_EQ(solve_conic(problem).outcome, ConicOutcome::optimal);
  strengthen(&problem, {0.24 * weight, 0.0, kNone});
  const ConicSolution falls = solve_conic(problem);
  EXPECT_EQ(falls.outcome, ConicOutcome::infeasible);
  EXPECT_GT(dual_value(problem, falls), 0.0) << "the weight's work exceeds what the joint dissipates";
}

// A block jammed between two walls (conic_test.cpp: any force is possible) presses with at most F per point.
TEST(ConicStrength, CompressionBoundsTheForcesOfAJammedBlock) {
  scenes::Scene scene(0.01, {0, 0, -scenes::kGravity});
  const int block = scene.add_box({0, 0, 0}, {1, 1, 1}, 2000.0);
  for (const double side : {-1.0, 1.0})
    scene.add_patch(scenes::kGround, block, {0.5 * side, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, {-side, 0, 0},
                    {.mu = 0.4});
  ConicProblem problem = conic(scene.problem());
  const double weight = 2000.0 * scenes::kGravity, F = 3.0 * weight;
  strengthen(&problem, {0.0, 0.0, F});
  problem.cost[0] = 1.0;
  EXPECT_NEAR(range(problem).second, F, kAgrees * F);
}

// The table of conic_test.cpp: N_++ = W (1 + x + y) / 4 + t over N_+- = W (1 + x - y) / 4 - t is least at the
// smallest t that the strength of the legs admits. The strength grows with the multiplier, as in range_end().
TEST(ConicStrength, RangeOfARatio) {
  const double W = 1000.0, x = 0.3, y = -0.2;
  ConicProblem problem = conic(scenes::table(W, x, y, 0.01, {.mu = 0.4}));
  problem.cost[0] = 1.0;
  problem.load_columns = problem.load;
  problem.load.setZero();
  problem.multiplier_cost = VecX::Zero(1);
  problem.rows = MatX::Zero(problem.cost.size(), 1);
  problem.rows(3, 0) = 1.0;
  problem.row_multipliers = MatX::Zero(1, 1);
  problem.row_values = VecX::Ones(1);
  const double a = (1 + x + y) / 4, b = (1 + x - y) / 4, d = (1 - x - y) / 4, F = 0.45;
  ASSERT_LT(F, b + std::min(a, d));
  strengthen(&problem, {0.0, 0.0, 0.0});
  problem.strength_columns = {std::vector(4, ContactStrength{0.0, 0.0, F * W})};
  const ConicSolution solution = solve_conic(problem);
  ASSERT_EQ(solution.outcome, ConicOutcome::optimal);
  EXPECT_NEAR(solution.primal, (a + b - F) / F, kAgrees);
  EXPECT_LE(conic_bounds(problem, solution).relative_gap(), 1e-6);
}

TEST(ConicStrength, RefusesCohesionWithoutFriction) {
  ConicProblem problem = conic(scenes::table(1000.0, 0, 0, 0.01, {.mu = 0.0}));
  strengthen(&problem, {0.0, 1.0, kNone});
  EXPECT_THROW(solve_conic(problem), std::invalid_argument);
}

}  // namespace
}  // namespace cupola::dry_problem_test
