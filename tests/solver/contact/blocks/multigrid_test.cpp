// The multigrid preconditioner for many blocks, and Newton's method with it.

#include "solver/contact/blocks/multigrid.hpp"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "solver/contact/methods/newton.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/runtime/threads.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::multigrid_test {
namespace {

const scenes::Joint kJoint{.mu = 0.4};
constexpr double kMotion = 0.003;  // s, a step in which inertia prevails

struct System {
  explicit System(ContactProblem of) : problem(std::move(of)) {
    std::vector<Mat3> G;
    for (int i = 0; i < problem.num_contacts(); ++i)
      G.push_back(contact_stiffness(contact_law(problem, i), -Vec3::UnitX()));
    H = assemble_hessian(white, graph, G);
    motions = rigid_motions(white, graph);
  }
  System(const System&) = delete;  // `white` refers to `problem`

  const ContactProblem problem;
  const WhitenedProblem white = whiten(problem);
  const ContactGraph graph = contact_graph(problem);
  BlockMatrix H;  ///< with all contacts sticking
  RigidMotions motions;
};

/// A deterministic vector that is no single mode.
VecX some_vector(int num_blocks) {
  VecX x(6 * num_blocks);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = std::sin(1.7 * static_cast<double>(i * i % 1009));
  return x;
}

/// CG iterations that reduce the residual by six digits.
int iterations_to_six_digits(const System& s, const Multigrid& multigrid) {
  constexpr int kMaxIterations = 500;
  VecX r = s.white.w_star;
  VecX z = multigrid.cycle(r), p = z;
  double rz = r.dot(z);
  const double target = 1e-12 * rz;
  int k = 0;
  for (; k < kMaxIterations && rz > target; ++k) {
    const VecX Hp = multiply(s.graph.pattern, s.H, p);
    r -= rz / p.dot(Hp) * Hp;
    z = multigrid.cycle(r);
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
  }
  return k;
}

// A common rigid motion of all blocks causes no relative velocity at the contacts between them. Rounding:
// arms of metres, D of order one.
TEST(RigidMotions, CauseNoRelativeVelocity) {
  const System s(scenes::dome({.rings = 10, .blocks_per_ring = 16}, 1.0, kJoint));
  const Eigen::Matrix<double, 6, 1> common{0.3, -0.2, 0.1, 0.05, -0.04, 0.02};
  VecX w(6 * s.problem.num_blocks());
  for (int k = 0; k < s.problem.num_blocks(); ++k)
    w.segment<6>(6 * k) = s.motions.motion[k] * moved_centre(Vec3::Zero(), s.motions.centre[k]) * common;
  const VecX v = s.white.to_v(w);
  for (int i = 0; i < s.problem.num_contacts(); ++i) {
    if (s.problem.block_a[i] == ContactProblem::kFixed) continue;
    EXPECT_LT(relative_velocity(s.problem, i, v).norm(), 1e-12) << "contact " << i;
  }
}

// The same across the seam of a sector, except at one line of joints, where the path around the axis closes.
TEST(RigidMotions, ContinueAcrossTheSeamOfASector) {
  const System s(scenes::dome({.rings = 10, .blocks_per_ring = 64, .sectors = 8}, 1.0, kJoint));
  const Eigen::Matrix<double, 6, 1> common{0.3, -0.2, 0.1, 0.05, -0.04, 0.02};
  VecX w(6 * s.problem.num_blocks());
  for (int k = 0; k < s.problem.num_blocks(); ++k)
    w.segment<6>(6 * k) = s.motions.motion[k] * moved_centre(Vec3::Zero(), s.motions.centre[k]) * common;
  const VecX v = s.white.to_v(w);
  int torn = 0, free = 0;
  for (int i = 0; i < s.problem.num_contacts(); ++i) {
    if (s.problem.block_a[i] == ContactProblem::kFixed || s.problem.block_b[i] == ContactProblem::kFixed)
      continue;
    ++free;
    torn += relative_velocity(s.problem, i, v).norm() > 1e-12;
  }
  EXPECT_GT(torn, 0);
  EXPECT_LT(torn, 0.3 * free);  // 1.5 of the 8 blocks of a ring lie at this line
}

TEST(RigidMotions, AreEmptyIfContactsAreNotInSpace) {
  ContactProblem problem = scenes::dome({.rings = 4, .blocks_per_ring = 8}, 1.0, kJoint);
  for (Lever& D : problem.D_b) D.frame(0, 0) += 0.1;
  const WhitenedProblem white = whiten(problem);
  EXPECT_TRUE(rigid_motions(white, contact_graph(problem)).empty());
}

// Under gravity. The bound is twice the measured number (10 and 11). With motions that neighbours do not
// share it is ten times as large (117 and 238), so the number shows whether aggregates preserve rigid
// motions.
TEST(Multigrid, NeedsFewIterationsForAnyNumberOfBlocks) {
  for (const int refine : {1, 2}) {
    System s(scenes::dome({.rings = 40 * refine, .blocks_per_ring = 40 * refine}, 100.0, kJoint));
    Multigrid multigrid;
    ASSERT_TRUE(multigrid.build(s.graph.pattern, s.H, s.motions));
    EXPECT_LE(iterations_to_six_digits(s, multigrid), 22) << refine;
    for (std::size_t k = 0; k < s.motions.motion.size(); ++k) {
      const auto scrambled = [k](Eigen::Index r, Eigen::Index c) {
        return (r == c) + 0.5 * std::sin(3.7 * static_cast<double>(k) + 1.3 * static_cast<double>(r) +
                                         2.9 * static_cast<double>(c * r));
      };
      s.motions.motion[k] = Mat6::NullaryExpr(scrambled);
    }
    ASSERT_TRUE(multigrid.build(s.graph.pattern, s.H, s.motions));
    EXPECT_GT(iterations_to_six_digits(s, multigrid), 60) << refine;
  }
}

TEST(Multigrid, IsSymmetricPositiveDefinite) {
  for (const double h : {100.0, kMotion}) {
    const System s(scenes::dome({.rings = 80, .blocks_per_ring = 80}, h, kJoint));
    Multigrid multigrid;
    ASSERT_TRUE(multigrid.build(s.graph.pattern, s.H, s.motions));
    const VecX x = some_vector(s.problem.num_blocks()), y = x.reverse();
    const VecX Bx = multigrid.cycle(x), By = multigrid.cycle(y);
    EXPECT_GT(x.dot(Bx), 0.0);
    // Rounding: the condition number of the matrix is 1e8 in statics.
    EXPECT_NEAR(y.dot(Bx), x.dot(By), 1e-8 * std::sqrt(x.dot(Bx) * y.dot(By))) << h;
  }
}

// 6,400 blocks: two pieces of a sweep, and enough work for a second thread in products.
TEST(Multigrid, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const double h : {100.0, kMotion}) {
    const System s(scenes::dome({.rings = 80, .blocks_per_ring = 80}, h, kJoint));
    const VecX x = some_vector(s.problem.num_blocks());
    VecX expected;
    for (const int threads : {1, 2, 3}) {
      set_num_threads(threads);
      Multigrid multigrid;
      ASSERT_TRUE(multigrid.build(s.graph.pattern, s.H, s.motions));
      const VecX y = multigrid.cycle(x);
      if (threads == 1) expected = y;
      EXPECT_TRUE((y.array() == expected.array()).all()) << threads << " threads, h = " << h;
    }
  }
  set_num_threads(1);
}

TEST(Multigrid, RejectsIndefiniteMatricesAndNaN) {
  System s(scenes::dome({.rings = 40, .blocks_per_ring = 40}, 100.0, kJoint));
  Multigrid multigrid;
  const Mat6 valid = s.H.diagonal[9];
  s.H.diagonal[9] = -valid;
  EXPECT_FALSE(multigrid.build(s.graph.pattern, s.H, s.motions));
  s.H.diagonal[9](2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(multigrid.build(s.graph.pattern, s.H, s.motions));
  s.H.diagonal[9] = valid;
  EXPECT_TRUE(multigrid.build(s.graph.pattern, s.H, s.motions));
}

TEST(NewtonDirection, IsZeroForAZeroRightHandSide) {
  const System s(scenes::dome({.rings = 40, .blocks_per_ring = 40}, 100.0, kJoint));
  VecX d;
  SolveSummary summary;
  ASSERT_TRUE(NewtonDirection().solve_by_multigrid(
      s.graph.pattern, s.H, s.motions, VecX::Zero(6 * s.problem.num_blocks()), 0.1, &d, &summary));
  EXPECT_TRUE(d.isZero());
  EXPECT_EQ(summary.conjugate_gradients, 0);
}

// A quarter of the contacts opens. Prolongations that were smoothed by the old matrix serve nearly as well as
// new ones, which the old matrices do not.
TEST(Multigrid, ServesAnotherMatrixWithTheSameProlongations) {
  System s(scenes::dome({.rings = 60, .blocks_per_ring = 60}, 100.0, kJoint));
  Multigrid kept, old, fresh;
  ASSERT_TRUE(kept.build(s.graph.pattern, s.H, s.motions));
  ASSERT_TRUE(old.build(s.graph.pattern, s.H, s.motions));
  std::vector<Mat3> G;
  for (int i = 0; i < s.problem.num_contacts(); ++i)
    G.push_back(i % 4 == 0 ? Mat3(Mat3::Zero())
                           : contact_stiffness(contact_law(s.problem, i), -Vec3::UnitX()));
  s.H = assemble_hessian(s.white, s.graph, G);
  ASSERT_TRUE(kept.rebuild(s.graph.pattern, s.H));
  ASSERT_TRUE(fresh.build(s.graph.pattern, s.H, s.motions));
  const int with_new = iterations_to_six_digits(s, fresh), with_kept = iterations_to_six_digits(s, kept);
  EXPECT_LE(with_kept, 1.2 * with_new);
  EXPECT_GT(iterations_to_six_digits(s, old), with_kept) << with_new << " " << with_kept;
}

TEST(NewtonDirection, DropsAFactorThatCosts) {
  const System s(scenes::dome({.rings = 12, .blocks_per_ring = 16}, 0.03, kJoint));
  std::vector<Mat3> G;
  for (int i = 0; i < s.problem.num_contacts(); ++i)
    G.push_back(i % 2 == 0 ? Mat3(Mat3::Zero())
                           : contact_stiffness(contact_law(s.problem, i), -Vec3::UnitX()));
  const BlockMatrix opened = assemble_hessian(s.white, s.graph, G);
  const VecX rhs = some_vector(s.problem.num_blocks());
  NewtonDirection direction;
  SolveSummary summary;
  VecX d;
  const auto lagged = [&](const BlockMatrix& H) {
    return direction.solve_lagged(s.graph.pattern, H, rhs, 1e-3, &d, &summary);
  };
  ASSERT_TRUE(direction.solve_directly(s.graph.pattern, s.H, rhs, &d, &summary));
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(lagged(s.H)) << "the factor of the matrix itself is kept";
  const int before = summary.conjugate_gradients;
  EXPECT_TRUE(lagged(opened));
  EXPECT_GT(summary.conjugate_gradients - before, 12) << "with every second contact open it serves badly";
  EXPECT_FALSE(lagged(opened)) << "and is dropped";
}

/// Compares forces found with multigrid to those found with factors.
void expect_same_forces(const ContactProblem& problem) {
  SolveOptions options;
  options.tolerance = 1e-10;
  options.reference_speed = scenes::kGravity * problem.h;
  options.lag_factor = true;  // as in motions
  options.multigrid = true;
  ContactSolution by_multigrid, by_factor;
  const SolveSummary with = NewtonSolver().solve(problem, options, &by_multigrid);
  ASSERT_EQ(with.ending, SolveEnding::converged) << with.message;
  EXPECT_EQ(with.factorizations, 0);
  EXPECT_GT(with.conjugate_gradients, 0);
  options.multigrid = false;
  const SolveSummary without = NewtonSolver().solve(problem, options, &by_factor);
  ASSERT_EQ(without.ending, SolveEnding::converged) << without.message;
  EXPECT_GT(without.factorizations, 0);
  // c = 1e-8 m/N, both solved to a momentum residual of 1e-10
  EXPECT_LT((by_multigrid.gamma - by_factor.gamma).norm(), 1e-6 * by_factor.gamma.norm());
}

TEST(NewtonWithMultigrid, FindsTheForcesFoundWithFactors) {
  expect_same_forces(scenes::dome({.rings = 100, .blocks_per_ring = 104, .gap = 1e-5}, 100.0, kJoint));
}

// A step of a motion, with sweeps alone and, on joints a million times as stiff, with a hierarchy.
TEST(NewtonWithMultigrid, FindsTheForcesOfAMotionFoundWithFactors) {
  ContactProblem problem = scenes::dome({.rings = 40, .blocks_per_ring = 40}, kMotion, kJoint);
  expect_same_forces(problem);
  for (int i = 0; i < problem.num_contacts(); i += 3) problem.E.segment<3>(3 * i) *= 1e-6;
  expect_same_forces(problem);
}

TEST(NewtonWithMultigridSlow, FindsTheForcesInASector) {
  expect_same_forces(scenes::dome({.rings = 128, .blocks_per_ring = 640, .sectors = 8}, 100.0, kJoint));
}

// Contacts whose directions are not orthonormal do not give the positions of the blocks: factors are used.
TEST(NewtonWithMultigridSlow, UsesFactorsIfContactsAreNotInSpace) {
  ContactProblem problem = scenes::dome({.rings = 100, .blocks_per_ring = 104}, 100.0, kJoint);
  for (Lever& D : problem.D_a) D.frame *= 2.0;
  for (Lever& D : problem.D_b) D.frame *= 2.0;
  SolveOptions options;
  options.tolerance = 1e-8;
  options.reference_speed = scenes::kGravity * problem.h;
  ContactSolution solution;
  const SolveSummary summary = NewtonSolver().solve(problem, options, &solution);
  EXPECT_EQ(summary.ending, SolveEnding::converged) << summary.message;
  EXPECT_GT(summary.factorizations, 0);
  EXPECT_EQ(summary.conjugate_gradients, 0);
}

/// First step of a dome that slides down, from rest.
SolveSummary step_from_rest(int size, double mu, bool multigrid) {
  const ContactProblem problem =
      scenes::dome({.rings = size, .blocks_per_ring = size}, 0.05, {.mu = mu, .c_n = 1e-9, .c_t = 1e-9});
  SolveOptions options;
  options.tolerance = 1e-4;
  options.reference_speed = scenes::kGravity * problem.h;
  options.lag_factor = true;
  options.multigrid = multigrid;
  ContactSolution solution;
  solution.v = VecX::Zero(problem.v_star.size());
  return NewtonSolver().solve(problem, options, &solution);
}

// Takes 21 iterations, and 73 without block descent.
TEST(Newton, EndsSlowSolvesByBlockDescent) {
  const SolveSummary summary = step_from_rest(40, 0.02, false);
  EXPECT_EQ(summary.ending, SolveEnding::converged) << summary.message;
  EXPECT_LE(summary.iterations, 40);
}

// The residual rises at first, and is smaller than at the start only after more iterations than multigrid
// gets without progress.
TEST(NewtonWithMultigridSlow, IsKeptWhileTheResidualFalls) {
  const SolveSummary summary = step_from_rest(80, 0.05, true);
  EXPECT_EQ(summary.ending, SolveEnding::converged) << summary.message;
  const auto& history = summary.residual_history;
  ASSERT_GT(history.size(), 15);
  EXPECT_GT(*std::min_element(history.begin() + 1, history.begin() + 16), history.front());
  EXPECT_EQ(summary.factorizations, 0);
}

// A chain of 10,000 voussoirs is so flexible (condition number 1e16) that directions of a few digits make no
// progress. The loop detects this and restarts with factors, which reduce the residual as far as rounding
// permits.
TEST(NewtonWithMultigridSlow, FallsBackToFactorsWithoutProgress) {
  const ContactProblem problem = scenes::arch(10000, 0.3, 1.4, 0.0, 100.0, kJoint);
  SolveOptions options;
  options.tolerance = 1e-8;
  options.reference_speed = scenes::kGravity * problem.h;
  options.max_iterations = 30;
  ContactSolution solution;
  const SolveSummary summary = NewtonSolver().solve(problem, options, &solution);
  EXPECT_GT(summary.factorizations, 0);
  ASSERT_FALSE(summary.residual_history.empty());
  const auto& history = summary.residual_history;
  EXPECT_LT(*std::min_element(history.begin(), history.end()), 1e-2 * history.front());
}

}  // namespace
}  // namespace cupola::multigrid_test
