#include "solver/contact/methods/coulomb_subproblem.hpp"

#include <gtest/gtest.h>

#include "solver/contact/methods/coulomb_direction.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::coulomb_subproblem_test {
namespace {

using scenes::kGravity;
using scenes::kGround;

constexpr double kStep = 0.01;  // s

/// Whether rigid contacts stick in the first subproblem of CoulombNewton.
bool sticks(const ContactProblem& problem) {
  const WhitenedProblem white = whiten(problem);
  const ContactGraph graph = contact_graph(problem);
  const CoulombSubproblem sub{white, 0.0, root_mean_mass(problem), delassus_traces(problem) / 3.0,
                              VecX::Zero(problem.b.size())};
  const StickingSystem system = sticking_system(sub);
  VecX w;
  BlockLu lu;
  SolveSummary summary;
  EXPECT_TRUE(CoulombDirection(white, graph, &lu).solve_symmetric(system.G, system.rhs, &w, &summary));
  return keeps_sticking(sub, point_at(sub, w));
}

scenes::Joint rigid(double friction) {
  return {friction, 0.0, 0.0};
}

// The weight acts 0.1 m above four corners that are 1 m apart, so that the corners up the slope bear about
// 0.9 of the mean: slope 0.5 needs friction 0.55 there.
TEST(CoulombSubproblem, SticksOnAnInclineBelowTheAngleOfFriction) {
  EXPECT_TRUE(sticks(scenes::incline(0.5, kStep, rigid(0.6))));
  EXPECT_FALSE(sticks(scenes::incline(0.5, kStep, rigid(0.45))));
  EXPECT_FALSE(sticks(scenes::incline(0.5, kStep, rigid(0.6), 0.0, 1e-3))) << "with a gap";
}

/// n unit cubes of density 1 between upright walls, and a cube of the density `weight` on the ground.
ContactProblem between_walls(int n, double friction, double weight) {
  scenes::Scene scene(kStep, {0, 0, -kGravity});
  int last = kGround;
  for (int k = 0; k <= n; ++k) {
    const int block = k == n ? kGround : scene.add_box({k + 0.5, 0, 5}, {1, 1, 1}, 1.0);
    scene.add_patch(last, block, {double(k), 0, 5}, {0, 0.5, 0}, {0, 0, 0.5}, {1, 0, 0}, rigid(friction));
    last = block;
  }
  const int beside = scene.add_box({0, 0, 0.5}, {1, 1, 1}, weight);
  scene.add_patch(kGround, beside, {0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 1}, rigid(friction));
  return scene.problem();
}

// Nothing presses one cube to the walls, and several pull their joints apart below, whatever the friction and
// whatever else there is.
TEST(CoulombSubproblem, DoesNotStickBetweenUprightWalls) {
  for (const int n : {1, 2, 3, 8})
    for (const double friction : {0.1, 1.0, 10.0})
      for (const double weight : {1.0, 1e9}) EXPECT_FALSE(sticks(between_walls(n, friction, weight))) << n;
  EXPECT_TRUE(sticks(between_walls(0, 0.1, 1.0))) << "the cube on the ground";
}

// The forces of a dome decay from ring to ring in the first subproblem; all of them are compared.
TEST(CoulombSubproblem, DomeSticksAtTheFrictionOfStone) {
  scenes::DomeShape shape;
  shape.rings = 8;
  shape.blocks_per_ring = 12;
  EXPECT_TRUE(sticks(scenes::dome(shape, kStep, rigid(0.4))));
  EXPECT_FALSE(sticks(scenes::dome(shape, kStep, rigid(0.02))));
}

}  // namespace
}  // namespace cupola::coulomb_subproblem_test
