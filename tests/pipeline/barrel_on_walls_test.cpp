// A barrel on two walls that are mirror images of each other: so are the forces in the tables.
#include <algorithm>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "tests/pipeline/static_run.hpp"

namespace cupola::barrel_on_walls_test {
namespace {

Evaluation barrel_walls(const std::vector<std::string>& settings = {}) {
  const ProgramFolder folder;
  return solve_and_evaluate(read_case(bundled_folder() + "/barrel_walls.yaml", settings), folder);
}

// The last course of the barrel stands on the second wall, whose uppermost course its joint does not carry.
TEST(BarrelOnWalls, BothWallsCarryTheSame) {
  const Evaluation e = barrel_walls();
  const std::vector<Sheet>& sheets = e.assembly.sheets;
  ASSERT_EQ(sheets.size(), 3u);
  const double rounding = 1e-6;  // the solver's tolerance is 1e-8 of a block's weight
  for (int course = 0; course < sheets[0].num_rings; ++course) {
    const RingSum &a = e.rings.at(sheets[0].first_ring + course),
                  &b = e.rings.at(sheets[1].first_ring + course);
    EXPECT_NEAR(a.height, b.height, rounding) << course;
    EXPECT_NEAR(a.largest_kern, b.largest_kern, rounding) << course;
    EXPECT_NEAR(a.largest_friction_use, b.largest_friction_use, rounding) << course;
    EXPECT_NEAR(a.mean_resultant, b.mean_resultant, rounding * a.mean_resultant) << course;
  }
}

// Outwards of a barrel is across it. Its lowest cut passes through both springings.
TEST(BarrelOnWalls, TheCutsOfItsWythePushAsItsSpringingsDo) {
  const Evaluation e = barrel_walls();
  const int first = e.assembly.sheets[2].first_ring;
  const double thrust = e.rings.at(first).radial_thrust;
  double of_wythes = 0.0, of_members = 0.0, down = 0.0;
  for (const WytheSum& sum : e.wythes)
    if (sum.ring == first) of_wythes += sum.outward_force;
  for (const MemberSum& sum : e.members)
    if (sum.ring == first) of_members += sum.outward_force, down += sum.vertical_force;
  EXPECT_NEAR(of_wythes, 2.0 * thrust, 1e-6 * thrust);
  EXPECT_NEAR(of_members, 2.0 * thrust, 1e-6 * thrust);
  // The uppermost courses of the walls carry themselves, the barrel and what lies on both.
  for (const int wall : {0, 1}) {
    const Sheet& sheet = e.assembly.sheets[wall];
    const int top = sheet.first_ring + sheet.num_rings - 1;
    double carried = 0.0;
    for (const WytheSum& sum : e.wythes)
      if (sum.ring == top) carried += sum.vertical_force;
    for (const Reaction& reaction : e.reactions)
      if (sheet.has_ring(reaction.ring)) {
        EXPECT_NEAR(reaction.outward, std::abs(reaction.force.x()), 1e-9 * down);
      }
    EXPECT_NEAR(carried, -e.rings.at(top).load_above.z() + 0.5 * down, 1e-6 * down);
  }
}

// A section has the nearest course of both walls, and of both haunches of the barrel, whose springings are
// level with the tops of the walls. The forces add up to the weight above; their horizontal parts cancel.
TEST(BarrelOnWalls, SectionsHaveBothSides) {
  const Evaluation e = barrel_walls({"postproc.sections=[-1.5, 0]"});
  const std::vector<Sheet>& sheets = e.assembly.sheets;
  ASSERT_EQ(e.sections.size(), 2u);
  ASSERT_EQ(e.sections[0].beds.size(), 2u);
  double above = 0.0;
  for (const size_t wall : {0u, 1u}) {
    EXPECT_TRUE(sheets[wall].has_ring(e.sections[0].beds[wall]));
    above -= e.rings.at(e.sections[0].beds[wall]).load_above.z();
  }
  const double barrel = -e.rings.at(sheets[2].first_ring).load_above.z();
  EXPECT_EQ(e.sections[1].beds,
            (std::vector{sheets[2].first_ring, e.shell.bed_above(e.shell.num_rings() - 1)}));
  const auto sum = [](const SectionEvaluation& section) {
    Vec3 force = Vec3::Zero();
    for (const BedResultant& r : section.resultants) force += r.wrench.force;
    return force;
  };
  const double error = 1e-6 * barrel;  // the solver's tolerance is 1e-8 of a block's weight
  EXPECT_LT((sum(e.sections[0]) - Vec3(0, 0, above + barrel)).norm(), error);
  EXPECT_LT((sum(e.sections[1]) - Vec3(0, 0, barrel)).norm(), error);
}

}  // namespace
}  // namespace cupola::barrel_on_walls_test
