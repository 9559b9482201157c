// The sentences of the first screen: why it stands or falls, under which loads, and what is certain of it.

#include <cmath>

#include <gtest/gtest.h>

#include "postproc/report/answers.hpp"
#include "postproc/report/loads_text.hpp"
#include "postproc/report/report.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::reasons_test {
namespace {

// Of a dry wall on fresh mortar: what holds its stages is not the law of the case's joints.
TEST(Reasons, AConstructionAssumesItsFreshMortar) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::staged;
  e.last.frame.role = FrameRole::stage;
  e.scene.joints.friction = 0.6;
  StagedConstruction& staged = e.scene.analysis.staged;
  staged.fresh.cohesion = 5e4;
  staged.fresh.tension = 4e4;
  const auto expect = [&e](const char* how, const char* laws) {
    const std::string text = certain_sentence(e);
    EXPECT_NE(text.find(how), std::string::npos) << text;
    EXPECT_NE(text.find(laws), std::string::npos) << text;
  };
  expect("balance the loads within the limits of the joints. ",
         "coefficients of friction of 0.1 to 0.6, the strength of fresh mortar, ");
  staged.fresh = {};
  expect("by friction and without tension. ", "coefficients of friction of 0.1 to 0.6, no crushing");
  staged.curing.resize(2);
  staged.curing[0].law.friction = 0.2;
  staged.curing[0].law.cohesion = 500.0;
  staged.curing[1].law.friction = 0.3;
  expect("within the limits", "coefficients of friction of 0.2 to 0.6, the strength of fresh mortar, ");
}

/// The column with a tie.
Evaluation tied_column() {
  const Assembly a = test::column(3);
  return test::evaluated(a, {test::column_with_a_tie(a)}, test::column_summary(a), test::column_case(),
                         test::fresh_folder("results"));
}

// A stone that hangs from ties has no joints.
TEST(Reasons, TiesCarryWhatHasNoJoints) {
  Evaluation e = tied_column();
  e.last.joints.wrenches.clear();
  EXPECT_TRUE(reason_for_verdict(e).starts_with("The ties carry the weight of 3 blocks"))
      << reason_for_verdict(e);
  EXPECT_NE(certain_sentence(e).find("forces exist that balance the loads in the ties. "), std::string::npos)
      << certain_sentence(e);
}

// What stands by a tie or a prop does not stand by friction alone, and heat changes its forces.
TEST(Reasons, NamesTiesRestraintsAndHeat) {
  Evaluation e = tied_column();
  const auto expect = [&e](const std::string& carriers, const std::string& how, const std::string& assumed) {
    EXPECT_TRUE(reason_for_verdict(e).starts_with("The joint forces" + carriers + " carry the weight"))
        << reason_for_verdict(e);
    const std::string certain = certain_sentence(e);
    EXPECT_NE(certain.find("balance the loads by friction" + how + ". Assumed: "), std::string::npos)
        << certain;
    EXPECT_NE(certain.find("friction of 0.5, " + assumed + "no crushing"), std::string::npos) << certain;
  };
  e.scene.joints.friction = 0.5;
  const std::string by = ", without tension in the joints, and by the ";
  expect(" and ties", by + "ties", "the ties and their yield forces, ");
  TieTable& ties = e.last.frame.ties;
  e.scene.supports.restraints = {{BlockRef{3}, Vec3::Zero(), Vec3::UnitX()}};
  for (const int strut : {0, 1}) {  // both signs of the restraint
    ties.block_a.push_back(0);
    ties.block_b.push_back(3);
    ties.strut.push_back(static_cast<std::uint8_t>(strut));
    ties.yield_force.push_back(INFINITY);
  }
  const std::string both = "the ties and their yield forces, the restraints, ";
  ties.force = {1234.0, 0.0, 5000.0};
  expect(", ties and restraints", by + "ties and restraints", both);
  ties.force = {0.0, 0.0, 5000.0};
  expect(" and restraints", by + "restraints", both);
  ties.force = {0.0, 0.0, 0.0};
  e.scene.loads.heat.resize(1);
  expect("", " and without tension", both + "the changes of temperature, ");
}

TEST(Reasons, SaysWhetherTheVerdictIsProven) {
  for (const auto& [status, words, good] : {std::tuple{Status::stable, "It stands", true},
                                            {Status::stable_unproven, "It stands, not proven", true},
                                            {Status::moving, "It falls", false},
                                            {Status::moving_unproven, "It falls, not proven", false},
                                            {Status::collapsed, "It falls", false},
                                            {Status::bracketed, "Undecided", false},
                                            {Status::unconverged, "Undecided", false}}) {
    Summary run;
    run.status = status;
    EXPECT_EQ(words_of_run(run).words, words);
    EXPECT_EQ(words_of_run(run).good, good) << words;
  }
  Evaluation e = test::column_evaluation(0.6, 0.4);
  EXPECT_TRUE(certain_sentence(e).starts_with("Certain: forces")) << certain_sentence(e);
  e.summary.status = Status::stable_unproven;
  EXPECT_TRUE(certain_sentence(e).starts_with("Not certain: forces")) << certain_sentence(e);
}

// The bound of the error holds for exact forces, which may not exist if the verdict is not proven.
TEST(Reasons, ABoundOfUnprovenForcesHoldsIfExactOnesExist) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.forces_unique = {true, "compliant"};
  e.summary.certified_force_error = {6e-6, "relative error of the wrench on any joint"};
  EXPECT_TRUE(how_sure(e).starts_with("The forces of this model are proven to 5 digits")) << how_sure(e);
  e.summary.status = Status::stable_unproven;
  EXPECT_TRUE(how_sure(e).starts_with("If exact forces exist, the forces")) << how_sure(e);
}

// A support that tilts about its centroid has moved, too.
TEST(Reasons, SupportsThatOnlyTurnHaveMoved) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  const double half = 0.5 * 0.05 / kDegrees;
  e.last.frame.blocks.quaternion_wxyz[0] = Eigen::Vector4d(std::cos(half), std::sin(half), 0, 0);
  EXPECT_TRUE(reason_for_verdict(e).ends_with(", although support block 0 has turned by 0.05 degrees."))
      << reason_for_verdict(e);
  EXPECT_NE(certain_sentence(e).find("after the motion of the supports"), std::string::npos);
  e.last.frame.blocks.displacement[0] = Vec3(0.01, 0, 0);
  EXPECT_EQ(moved_text(e), "support block 0 has moved by 10 mm and turned by 0.05 degrees");
}

// A motion that ends below the threshold of collapse has not fallen, whatever still moves.
TEST(Reasons, AMotionThatGoesOnHasNotFallen) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.last.frame.role = FrameRole::step;
  e.last.frame.time = 4.0;
  e.last.frame.blocks.displacement[2] = Vec3(0.007, 0, 0);
  e.summary.analysis = AnalysisType::dynamic;
  e.summary.status = Status::moving;
  e.summary.max_speed_m_per_s = 0.004;
  e.summary.message = "largest speed 0.004 m/s > threshold 0.001 m/s at the end";
  EXPECT_EQ(verdict_words(e).words, "It has not come to rest");
  EXPECT_FALSE(verdict_words(e).good);
  EXPECT_TRUE(
      reason_for_verdict(e).starts_with("Within 4 s a block moves by 7 mm; a displacement above 500 mm "
                                        "counts as collapse. At the end it is not "
                                        "at rest: largest speed 0.004 m/s > threshold 0.001 m/s at the end."))
      << reason_for_verdict(e);
  EXPECT_EQ(margin_answer(e).value, "unknown");
  e.summary.status = Status::collapsed;
  EXPECT_EQ(verdict_words(e).words, "It falls");
}

// Only statics prove that forces exist.
TEST(Reasons, AMotionThatCameToRestProvesNoEquilibrium) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  EXPECT_TRUE(certain_sentence(e).starts_with("Certain: forces exist")) << certain_sentence(e);
  e.summary.analysis = AnalysisType::dynamic;
  e.last.frame.role = FrameRole::step;
  EXPECT_TRUE(certain_sentence(e).starts_with("Certain: nothing beyond the motion computed. "))
      << certain_sentence(e);
}

// 12 kN of fill and forces beside the weight: the verdict names them and their sum.
TEST(Reasons, NamesTheLoadsBesideTheWeight) {
  EXPECT_EQ(loads_text(test::column_evaluation(0.6, 0.4)), "");
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.acting.forces.resize(1);
  e.acting.faces.resize(2);
  e.acting.faces[0].fill = Fill{.level = 2.0, .from = {}, .unit_weight = 18e3};
  e.summary.weight_N = 40e3;
  e.last.loads = {{1, Vec3::Zero(), Vec3(3e3, 0, -8e3), 1},
                  {1, Vec3::Zero(), Vec3(-3e3, 0, -1e3), 1},
                  {2, Vec3::Zero(), Vec3(0, 0, -3e3), 0}};
  EXPECT_EQ(loads_text(e), "fill of 9 kN and forces of 3 kN, 52 kN in all");
  EXPECT_NE(reason_for_verdict(e).find("40 kN, fill of 9 kN and forces of 3 kN, 52 kN in all."),
            std::string::npos)
      << reason_for_verdict(e);
  e.last.loads.push_back({2, Vec3::Zero(), Vec3(0, 0, -4e3), PointForce::kDeadLoad});
  EXPECT_EQ(loads_text(e), "load on top of 4 kN, fill of 9 kN and forces of 3 kN, 56 kN in all");
  EXPECT_EQ(weight_text(e), "40 kN");
  e.last.loads.push_back({1, Vec3::Zero(), Vec3(0, -2e3, 0), 0});  // wind
  EXPECT_EQ(
      loads_text(e),
      "load on top of 4 kN, fill of 9 kN and forces of 3 kN, 56 kN in all; horizontal loads of 2 kN, 0.05 of "
      "the weight");
  e.last.loads.pop_back();
  e.last.gravity *= 0.25;  // as `dead_load_time` has it at that time
  EXPECT_EQ(weight_text(e), "10 kN of 40 kN");
  EXPECT_EQ(loads_text(e), "load on top of 4 kN, fill of 9 kN and forces of 3 kN, 26 kN in all");
}

// The limits of an acceleration and of a tilt to 3:4 pull 40 kN: to the side, and of a tilt less downwards.
TEST(Reasons, WeightPullsToTheSideInLimitsOfTiltAndAcceleration) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  const double g = e.scene.loads.gravity.norm();
  e.acting.forces.resize(1);
  e.summary.weight_N = 40e3;
  e.last.loads = {{1, Vec3::Zero(), Vec3(0, 0, -4e3), PointForce::kDeadLoad}};
  e.acting.pull = g * Vec3(0.5, 0, 0);
  e.last.gravity = g * Vec3(0.5, 0, -1);
  EXPECT_EQ(weight_text(e), "40 kN");
  EXPECT_EQ(loads_text(e), "load on top of 4 kN, 44 kN in all; horizontal loads of 20 kN, 0.5 of the weight");
  e.acting.pull.setZero();
  e.last.gravity = g * Vec3(0, 0.6, -0.8);
  EXPECT_EQ(weight_text(e), "32 kN of 40 kN");
  EXPECT_EQ(loads_text(e), "load on top of 4 kN, 36 kN in all; horizontal loads of 24 kN, 0.6 of the weight");
}

TEST(Reasons, KnowsThatTheJointsOfSomeRingsMayCrush) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  EXPECT_NE(certain_sentence(e).find("no crushing (not checked)"), std::string::npos);
  e.scene.joints.rings.push_back({});
  e.scene.joints.rings.back().law.compressive_strength = 1e6;
  EXPECT_EQ(certain_sentence(e).find("no crushing"), std::string::npos) << certain_sentence(e);
}

TEST(Reasons, SayUpToWhichCourseAConstructionWasComputed) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::staged;
  e.last.frame.role = FrameRole::stage;
  for (const int all : {-1, 2}) {
    e.scene.analysis.staged.last_ring = all;
    EXPECT_EQ(reason_for_verdict(e), "Every stage of the construction stands.");
  }
  e.scene.analysis.staged.last_ring = 1;
  EXPECT_EQ(reason_for_verdict(e),
            "Every stage of the construction stands. Computed up to course 1 only, with "
            "`analysis.staged.last_ring`; the last of the model is 2.");
}

TEST(Reasons, SaysThatNoEquilibriumExistsOnlyIfThatIsProven) {
  Summary summary;
  for (const auto& [status, lack] : {std::pair{Status::moving, "no equilibrium exists."},
                                     std::pair{Status::moving_unproven, "no equilibrium was found."}}) {
    summary.status = status;
    EXPECT_EQ(verdict_text(summary, FrameRole::mechanism), std::string("Under these loads ") + lack);
    EXPECT_EQ(verdict_text(summary, FrameRole::path), std::string("Beyond the end of the path ") + lack);
    EXPECT_EQ(verdict_text(summary, FrameRole::step), "The structure is moving.") << "no proof in a motion";
  }
}

}  // namespace
}  // namespace cupola::reasons_test
