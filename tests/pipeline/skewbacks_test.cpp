// An arch that slides on level beds of its springing, and what the first screen says about it.

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "postproc/report/gives_way.hpp"
#include "tests/pipeline/static_run.hpp"

namespace cupola::skewbacks_test {
namespace {

// The profile of barrel_walls rises from its springing at atan(0.75), 36.9 degrees from the vertical, and the
// chord of its first course a little flatter: by half the turn of a course, 106.3 / 17 / 2 degrees.
TEST(Skewbacks, AreNamedWhereAnArchSlidesOnSteepLevelBeds) {
  Evaluation e;
  e.scene = read_case(bundled_folder() + "/barrel_walls.yaml");
  e.assembly = generate(e.scene);
  e.rings.resize(static_cast<size_t>(e.assembly.num_rings));
  const int springing = e.assembly.sheets.back().first_ring;
  MechanismMotion motion;
  motion.joints.sliding = 4;
  motion.sliding = 1.0;
  motion.by_course[{springing, false}].sliding = 1.0;
  motion.by_course[{springing, false}].on = e.assembly.sheets.front().num_rings - 1;
  e.gives_way = motion;
  EXPECT_NE(how_it_gives_way(e).find("; barrel slides on level beds, which its profile leaves at 40 degrees"),
            std::string::npos)
      << how_it_gives_way(e);
  e.scene.joints.friction = 1.0;
  EXPECT_EQ(how_it_gives_way(e).find("level beds"), std::string::npos) << "friction holds it";
  e.scene.joints.friction = 0.6;
  e.gives_way->by_course[{springing, false}].on = springing;
  EXPECT_EQ(how_it_gives_way(e).find("level beds"), std::string::npos) << "a head joint";
}

// An arch that has them slides on no level bed. Their joints carry it as those of its other courses do: as
// heads they were in no row of the rings.
TEST(Skewbacks, AreTheSpringingOfTheirArch) {
  const ProgramFolder folder;
  Evaluation e = solve_and_evaluate(
      read_case(bundled_folder() + "/bridge_abutments.yaml", {"analysis={type: static}"}), folder);
  const Sheet& arch = e.assembly.sheets.back();
  const RingSum& springing = e.rings.at(arch.first_ring);
  EXPECT_GT(springing.mean_resultant, 0.0);
  EXPECT_GT(springing.largest_friction_use, 0.0);
  MechanismMotion motion;
  motion.joints.sliding = 4;
  motion.sliding = 1.0;
  motion.by_course[{arch.first_ring, false}].sliding = 1.0;
  motion.by_course[{arch.first_ring, false}].on = e.assembly.sheets.front().num_rings - 1;
  e.gives_way = motion;
  e.scene.joints.friction = 0.2;
  EXPECT_EQ(how_it_gives_way(e).find("level beds"), std::string::npos) << how_it_gives_way(e);
}

}  // namespace
}  // namespace cupola::skewbacks_test
