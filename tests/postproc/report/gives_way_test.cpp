#include "postproc/report/gives_way.hpp"

#include <gtest/gtest.h>

#include "postproc/mechanics/joint_speeds.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/report/first_screen.hpp"
#include "postproc/report/worst_joints.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::gives_way_test {
namespace {

// The upper two of three blocks slide off the lowest one and tip: the bed at 0.5 m slides at full speed and
// opens at x = 0.
TEST(GivesWay, AMechanismShowsWhichJointsGiveWay) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
  for (const size_t b : {2u, 3u}) frame.blocks.velocity[b] = Vec3(2.0, 0, 0);
  Summary summary = test::column_summary(a);
  summary.status = Status::moving;
  summary.friction_law = FrictionLaw::associated;
  const auto evaluation = [&](const std::string& folder) {
    return test::evaluated(a, {frame}, summary, test::column_case(), test::fresh_folder(folder));
  };
  Evaluation e = evaluation("slides");
  std::vector<KeyNumber> numbers = key_numbers(e, {});
  ASSERT_EQ(numbers.size(), 4u);
  EXPECT_EQ(numbers[0].name, "Margin");
  EXPECT_EQ(numbers[1].value, "2 of 3");
  EXPECT_EQ(numbers[2].value, "100 %") << numbers[2].name;
  EXPECT_EQ(numbers[3].value, "0 %") << numbers[3].name;
  EXPECT_NE(reason_for_verdict(e).find("It gives way by sliding (100 % of the motion of its joints): 1 joint "
                                       "slides; 100 % of the motion is at course 1 (z = 0.5 m, slides)."),
            std::string::npos)
      << reason_for_verdict(e);
  std::string html = first_screen(e, {}, nullptr, "");
  EXPECT_NE(html.find("Where it gives way"), std::string::npos);
  EXPECT_NE(
      html.find("data-block=\"2\">The bed joint between blocks 1 and 2</a> slides the fastest: at 100 %"),
      std::string::npos);
  EXPECT_EQ(html.find("opens the fastest"), std::string::npos);
  EXPECT_NE(html.find("The proof holds for every friction law"), std::string::npos);

  // Block 3 turns about y with 1 rad/s: about its centroid, so that its bed opens at 0.6 m/s at x = 0.
  for (const size_t b : {2u, 3u}) frame.blocks.velocity[b] = Vec3(b == 2 ? 0.0 : 2.0, 0, 0);
  frame.blocks.angular_velocity[3] = Vec3(0, 1.0, 0);
  e = evaluation("tips");
  const std::optional<MovingJoints> joints = moving_joints(e);
  ASSERT_TRUE(joints);
  EXPECT_NEAR(joints->opening.motion, 0.6 / 2.0, 1e-12);
  EXPECT_NEAR(joints->sliding.motion, (2.0 - 0.25) / 2.0, 1e-12) << "the bed lies 0.25 m below the centroid";
  EXPECT_EQ(e.last.joints.wrenches[joints->opening.index].block_b, 3);

  // The bed under block 2 turns with it about its edge at x = 1.2 m, and opens by 1.2 m/s at x = 0.
  for (const size_t b : {2u, 3u}) {
    const Vec3 arm = a.blocks[b].centroid - Vec3(1.2, 0.4, 0.5);
    frame.blocks.velocity[b] = Vec3::UnitY().cross(arm);
    frame.blocks.angular_velocity[b] = Vec3::UnitY();
  }
  e = evaluation("hinges");
  const MechanismMotion motion = mechanism_motion(a, e.last.frame, e.last.joints);
  EXPECT_NEAR(motion.hinging, 1.2 / frame.blocks.velocity[3].norm(), 1e-12) << "of the fastest block";
  EXPECT_NEAR(motion.sliding, 0.0, 1e-12);
  EXPECT_NE(reason_for_verdict(e).find("It gives way by hinging (100 %"), std::string::npos)
      << reason_for_verdict(e);
  e.gives_way.reset();
  EXPECT_EQ(how_it_gives_way(e), "");

  summary.status = Status::moving_unproven;
  html = first_screen(evaluation("unproven"), {}, nullptr, "");
  EXPECT_NE(html.find("It falls, not proven"), std::string::npos);
  EXPECT_EQ(html.find("It is proven"), std::string::npos);
  EXPECT_NE(html.find("That no forces balance the loads is not proven"), std::string::npos);
}

// Three blocks of 0.5 m above the sea: the same digits as at zero.
TEST(GivesWay, HeightsAboveTheSeaAreToldApart) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.rings.resize(3);
  MechanismMotion motion;
  motion.sliding = 2.0;
  motion.joints.sliding = 2;
  motion.by_course[{1, false}] = {.sliding = 1.0, .height = 1000.5, .on = 0};
  motion.by_course[{2, false}] = {.sliding = 1.0, .height = 1001.0, .on = 1};
  e.gives_way = motion;
  EXPECT_NE(how_it_gives_way(e).find("course 1 (z = 1000.5 m, slides), course 2 (z = 1001 m, slides)"),
            std::string::npos)
      << how_it_gives_way(e);
}

}  // namespace
}  // namespace cupola::gives_way_test
