// Which joints a run without equilibrium names, and under which heading.

#include "postproc/report/worst_joints.hpp"

#include <gtest/gtest.h>

#include "tests/postproc/scene.hpp"

namespace cupola::worst_joints_test {
namespace {

// A column in motion, one joint of which has opened by 10 mm.
TEST(WorstJoints, GiveWayOnlyIfItFalls) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.last.frame.role = FrameRole::step;
  e.last.joints.wrenches[0].opening = 0.01;
  e.summary.max_speed_m_per_s = 0.1;
  const auto html = [&e](Status status) {
    e.summary.status = status;
    return worst_joints_html(e);
  };
  const std::string goes_on = html(Status::moving), fallen = html(Status::collapsed);
  EXPECT_NE(goes_on.find("<strong>Joints that moved most</strong>"), std::string::npos) << goes_on;
  EXPECT_EQ(goes_on.find("gives way"), std::string::npos) << goes_on;
  EXPECT_NE(fallen.find("<strong>Where it gives way</strong>"), std::string::npos) << fallen;
  EXPECT_NE(goes_on.find("is open the widest"), std::string::npos) << goes_on;
}

}  // namespace
}  // namespace cupola::worst_joints_test
