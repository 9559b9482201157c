#include "postproc/report/first_screen.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "postproc/evaluation/thrust.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/report/gives_way.hpp"
#include "postproc/report/motion.hpp"
#include "postproc/report/report.hpp"
#include "postproc/report/worst_joints.hpp"
#include "postproc/tables/result_tables.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::first_screen_test {
namespace {

/// A joint of 1 m2 with a normal force (N), a friction use and a distance of the force from the edge (m).
JointWrench joint(double normal_force, double friction_use, double edge_distance) {
  JointWrench j;
  j.normal_force = normal_force;
  j.wrench.force = Vec3(0, 0, normal_force);
  j.friction_use = friction_use;
  j.edge_distance = edge_distance;
  j.patch.area = 1.0;
  return j;
}

TEST(FirstScreen, OfTheSlidingJointsTheMostLoadedIsTheWorst) {
  JointWrenches joints;
  joints.wrenches = {joint(1000, 0.5, 0.4), joint(10, 1.0, 0.5), joint(20, 0.9995, 0.5)};
  EXPECT_EQ(worst_joints(joints).sliding, 2u) << "both slide; which has the larger quotient is rounding";
  joints.wrenches[2].friction_use = 0.99;
  EXPECT_EQ(worst_joints(joints).sliding, 1u);
}

TEST(FirstScreen, TheWorstEdgeIsThatOfALoadedJoint) {
  JointWrenches joints;
  joints.wrenches = {joint(1000, 0.1, 0.4), joint(5, 0.1, 0.001), joint(500, 0.1, 0.3)};
  for (JointWrench& j : joints.wrenches) j.kern = (0.5 - j.edge_distance) * 6.0;  // of a square of 1 m2
  EXPECT_EQ(worst_joints(joints).edge, 2u) << "joint 1 carries less than a tenth of the largest force";
  joints.wrenches[2].patch.area = 0.36;
  joints.wrenches[2].kern = 0.0;  // 0.3 m are half of its side of 0.6 m
  EXPECT_EQ(worst_joints(joints).edge, 0u);
}

TEST(FirstScreen, NegligibleJointsAreNeverTheWorst) {
  JointWrenches joints;
  joints.wrenches = {joint(1e-9, 1.0, 0.0)};
  joints.wrenches[0].negligible = true;
  EXPECT_FALSE(worst_joints(joints).sliding);
  EXPECT_FALSE(worst_joints(joints).edge);
}

// A search for the least property of fresh mortar ends with words, or with a value that not all stages have.
TEST(FirstScreen, AConstructionWithoutALeastPropertySaysWhy) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::staged;
  e.scene.analysis.staged.least = StagedConstruction::Least::cohesion;
  const auto answer = [&e](Status status, FrameRole role, const char* found) {
    e.summary.status = status;
    e.last.frame.role = role;
    e.summary.sought =
        Sought{"critical fresh cohesion", found, "a clause (with another; and a third)", "", ""};
    const KeyNumber margin = margin_answer(e);
    EXPECT_EQ(margin.name, "Critical fresh cohesion");
    EXPECT_EQ(margin.detail(), "a clause (with another; and a third)");
    return margin.value;
  };
  EXPECT_EQ(answer(Status::moving, FrameRole::failed_stage, "none"), "none");
  EXPECT_EQ(answer(Status::stable, FrameRole::stage, "0"), "0");
  e.summary.critical = CriticalValue{"fresh cohesion", 1e4, 1e4, 0.99e4};
  EXPECT_EQ(answer(Status::unconverged, FrameRole::stage, ""), "unknown");
}

// The case may have asked for it: cohesion requires compliance per area.
TEST(FirstScreen, AConstructionThatFallsIsAdvisedToSearchWhatItsJointsCanHave) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::staged;
  e.summary.status = Status::moving;
  e.last.frame.role = FrameRole::failed_stage;
  for (const auto& [per, advice] : {std::pair(Compliance::Per::point, "`analysis.staged.least: friction`"),
                                    std::pair(Compliance::Per::area, "`analysis.staged.least: cohesion`")}) {
    e.scene.joints.compliance.per = per;
    EXPECT_TRUE(margin_answer(e).detail().ends_with(advice)) << margin_answer(e).detail();
    EXPECT_NE(margin_answer(e).detail().find("whether fresh mortar could hold it"), std::string::npos)
        << "not what tips or is crushed";
  }
}

TEST(FirstScreen, ALimitAnalysisBeginsWithItsCriticalValue) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::limit;
  e.summary.critical = CriticalValue{"tilt", 9.4623222, 9.4623221, 9.4623223};
  const std::vector<KeyNumber> numbers = key_numbers(e, {});
  ASSERT_EQ(numbers.size(), 1u) << "rigid joints have no cracks, and a column has no thrust";
  EXPECT_EQ(numbers[0].name, "Critical tilt");
  EXPECT_EQ(numbers[0].value, "9.4623 degrees");
}

// Heyman's factor is the inverse of the least extent of the joints, and of no thrust line shown.
TEST(FirstScreen, TheLeastExtentOfTheJointsIsAGeometricSafetyFactor) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::limit;
  e.scene.analysis.limit.parameter = LimitSearch::Parameter::joint_extent;
  e.summary.critical = CriticalValue{"joint_extent", 0.8, 0.8, 0.8 - 1e-9};
  const KeyNumber first = key_numbers(e, {}).front();
  EXPECT_EQ(first.name, "Geometric safety factor");
  EXPECT_EQ(first.value, "1.25");
  for (const std::string& sentence : finding_sentences(e))
    EXPECT_EQ(sentence.find("eometric safety"), std::string::npos) << sentence;
  EXPECT_NE(worst_joints_html(e).find("Worst joints, of 0.8 times their extent"), std::string::npos);
  EXPECT_TRUE(
      joint_table(e, e.last.joints.wrenches).title.starts_with("Joints, of 0.8 times their extent: "));
  EXPECT_TRUE(std::isnan(thrusts_of(e, e.assembly.sheets.front()).front().supports.front().length))
      << "shrunk joints are not as long as their support";
}

// On which side of its limit the case lies, by which factor, and what gives way beyond it.
TEST(FirstScreen, ALimitSaysWhetherTheCaseStandsAndByHowMuch) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::limit;
  e.scene.analysis.limit.parameter = LimitSearch::Parameter::friction;
  e.scene.joints.friction = 0.4;
  e.summary.critical = CriticalValue{"friction", 0.2, 0.2, 0.2 - 1e-9};
  e.gives_way = MechanismMotion{
      .joints = {.hinging = 4, .sliding = 1, .opening = 0},
      .hinging = 3.0,
      .sliding = 1.0,
      .parting = 0.0,
      .by_course = {{{0, false}, {.sliding = 1.0}}, {{1, false}, {.hinging = 3.0, .height = 0.5, .on = 0}}}};
  EXPECT_EQ(verdict_words(e).words, "It stands");
  const std::string detail = margin_answer(e).detail();
  EXPECT_EQ(
      detail,
      "the case has 0.4, 2 times what it needs; below it gives way by hinging (75 % of the motion of its "
      "joints) and sliding (25 %): hinges form at 4 joints, 1 other slides; 100 % of the motion is at "
      "course 1 (z = 0.5 m, hinges), course 0 on its support (z = 0 m, slides)");
  EXPECT_TRUE(
      reason_for_verdict(e).starts_with("The case has a friction of 0.4, 2 times what it needs: it stands "
                                        "down to 0.2 and moves below it (associated "
                                        "friction law)."))
      << reason_for_verdict(e);
  e.scene.joints.friction = 0.1;
  EXPECT_EQ(verdict_words(e).words, "It falls");
  EXPECT_TRUE(reason_for_verdict(e).starts_with("The case has a friction of 0.1, 0.5 times what it needs"));
  e.summary.critical = CriticalValue{"load", 8.0, 8.0, 8.1};
  e.scene.analysis.limit.parameter = LimitSearch::Parameter::load;
  EXPECT_EQ(verdict_words(e).words, "It stands") << "at a factor of 1";
  EXPECT_EQ(reason_for_verdict(e),
            "The forces of the case can grow to 8 times before it moves (associated friction "
            "law). Picture and thrust belong to "
            "the critical load, not to the case.");
  EXPECT_EQ(margin_answer(e).value, "8 times the load") << "the end that stands, not the middle";
  FaceLoad soil, wind;
  soil.fill.emplace();
  wind.pressure = 500.0;
  e.scene.loads.faces = {soil};
  EXPECT_TRUE(reason_for_verdict(e).starts_with(
      "The forces of the case (not its fill) can grow to 8 times before it moves ("))
      << reason_for_verdict(e);
  e.scene.loads.faces.push_back(wind);
  e.scene.loads.forces.emplace_back();
  e.scene.loads.lantern = TopLoad{.weight = 1000.0};
  e.summary.critical = CriticalValue{"load", 0.8, 0.8, 0.81};
  EXPECT_TRUE(reason_for_verdict(e).starts_with(
      "It bears only 0.8 times the forces and loads on faces of the case (not its fill and load on top) ("))
      << reason_for_verdict(e);
}

// A limit of one friction of all joints says nothing of a case whose joints differ.
TEST(FirstScreen, ALimitWithoutAValueOfTheCaseIsNoVerdict) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::limit;
  e.scene.analysis.limit.parameter = LimitSearch::Parameter::friction;
  e.scene.joints.bed.emplace().friction = 0.01;
  e.summary.critical = CriticalValue{"friction", 0.2, 0.2, 0.2 - 1e-9};
  EXPECT_EQ(verdict_words(e).words, "Limit found");
  EXPECT_TRUE(reason_for_verdict(e).starts_with("The structure stands down to a friction of 0.2"))
      << reason_for_verdict(e);
  EXPECT_EQ(margin_answer(e).detail(), "");
}

// A pull in one direction says nothing of the others.
TEST(FirstScreen, ALimitOfAnAccelerationNamesItsDirection) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.analysis = AnalysisType::limit;
  LimitSearch& limit = e.scene.analysis.limit;
  limit.parameter = LimitSearch::Parameter::acceleration;
  e.summary.critical = CriticalValue{"acceleration", 0.2, 0.2, 0.2 + 1e-9};
  limit.direction = {0.0, -2.0, 0.0};
  EXPECT_EQ(margin_answer(e).detail(), "pulled towards -y; other directions are not computed");
  EXPECT_TRUE(reason_for_verdict(e).ends_with("It is pulled towards -y; other directions are not computed."))
      << reason_for_verdict(e);
  limit.direction = {3.0, 4.0, 0.0};
  EXPECT_EQ(margin_answer(e).detail(), "pulled towards (0.6, 0.8, 0); other directions are not computed");
  limit.direction = {1.0, 0.0, 0.0};
  e.scene.loads.gravity = {3.0, 0.0, -4.0};  // which leans towards it
  EXPECT_EQ(margin_answer(e).detail(),
            "pulled towards (0.8, 0, 0.6), at right angles to gravity; other directions are not computed");
}

TEST(FirstScreen, WithoutAMarginItNamesTheCommandThatComputesOne) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.scene.file = "cases/my_dome.yaml";
  EXPECT_EQ(verdict_words(e).words, "It stands");
  EXPECT_EQ(margin_answer(e).value, "not computed");
  EXPECT_EQ(margin_answer(e).detail(), "to compute it: cupola assess my_dome.yaml");
  e.scene.file = "O'Neill's dome.yaml";
  EXPECT_EQ(margin_answer(e).detail(), "to compute it: cupola assess 'O'\\''Neill'\\''s dome.yaml'");
  Evaluation member = e;
  member.scene.file = "cases/domes.yaml";
  member.scene.sweep = {{"joints.friction", {"0.3", "0.4"}}};
  EXPECT_EQ(margin_answer(member).detail(),
            "to compute it: cupola assess a case that extends domes.yaml, with the values of this member");
  const std::vector<std::string> lines = terminal_lines(e, "post/report.html");
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_TRUE(lines.front().starts_with("It stands: The joint forces carry the weight of 3 blocks, "))
      << lines[0];
  EXPECT_EQ(lines.back(), "  report    post/report.html");
  EXPECT_EQ(lines[4], "  warnings  none");
  e.warnings = {"unstable balance"};
  EXPECT_EQ(terminal_lines(e, "")[4], "  warnings  unstable balance");
  e.warnings.emplace_back("another");
  EXPECT_EQ(terminal_lines(e, "")[4], "  warnings  2, in the report; the first: unstable balance");
}

// The motion of supports is a cause of displacement only where they move.
TEST(FirstScreen, AnAxisIsAdvisedForRingsAlone) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  EXPECT_EQ(terminal_lines(e, "")[3], "  thrust    none: a wall has no outside");
  e.assembly.sheets.clear();
  EXPECT_EQ(terminal_lines(e, "")[3],
            "  thrust    none: no courses, no axis: geometry.import.axis is for rings; import arches singly");
}

TEST(FirstScreen, TheLargestDisplacementNamesSupportsOnlyIfTheyMove) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.summary.max_displacement_m = 0.02;
  EXPECT_EQ(finding_sentences(e).back(), "The largest displacement of a block is 20 mm.");
  e.last.frame.blocks.displacement[0] = Vec3(0.01, 0, 0);
  EXPECT_EQ(finding_sentences(e).back(),
            "The largest displacement of a block is 20 mm, the motion of the supports included.");
}

// A path to 2 s that ends at 1.5 s under a tenth of the weight from the side.
TEST(FirstScreen, APathThatEndsEarlySaysWhatItBore) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.last.frame.role = FrameRole::path;
  e.last.frame.time = 1.5;
  e.scene.analysis.path.end = 2.0;
  e.summary.weight_N = 1e4;
  e.acting.forces.resize(1);
  e.last.loads = {{1, Vec3::Zero(), Vec3(600, 0, 0), 0}, {2, Vec3::Zero(), Vec3(0, 800, 0), 0}};
  EXPECT_EQ(margin_answer(e).value, "not computed") << "it reached its end";
  e.summary.status = Status::moving;
  EXPECT_EQ(margin_answer(e).name, "End of the path");
  EXPECT_EQ(margin_answer(e).value, "1.5 s of 2");
  EXPECT_EQ(margin_answer(e).detail(),
            "at the last equilibrium: horizontal loads of 1 kN, 0.1 of the weight");
  e.last.frame.blocks.displacement[0] = Vec3(0.01, 0, 0);
  EXPECT_TRUE(margin_answer(e).detail().ends_with("weight; support block 0 has moved by 10 mm"))
      << margin_answer(e).detail();
}

// A path by a length, with 1 kN at 2 s, that bore 600 N at 1.2 s and then unloaded to 300 N at 0.6 s.
TEST(FirstScreen, APathThatUnloadsSaysWhatItBoreAtMost) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.last.frame.role = FrameRole::path;
  e.last.frame.time = 0.6;
  e.scene.analysis.path.end = 2.0;
  e.summary.weight_N = 1e4;
  e.acting.forces.resize(1);
  e.acting.forces[0].time = RampInTime{.from = 0.0, .to = 1.0, .start = 0.0, .duration = 2.0};
  e.loads = {{1, Vec3::Zero(), Vec3(1000, 0, 0), 0}};
  e.times = {0.0, 1.2, 0.6};
  EXPECT_EQ(margin_answer(e).name, "Largest loads");
  EXPECT_EQ(margin_answer(e).value, "horizontal loads of 0.6 kN, 0.06 of the weight");
  EXPECT_EQ(margin_answer(e).detail(),
            "at 1.2 s of 2; the path ends at 0.6 s; of the equilibria found: between them the loads may be "
            "larger");
  EXPECT_EQ(verdict_words(e).words, "It stands");
  e.summary.bears_loads_until_s = 1.2;
  EXPECT_EQ(verdict_words(e).words, "It bears part of its loads");
  EXPECT_FALSE(verdict_words(e).good);
  EXPECT_TRUE(reason_for_verdict(e).starts_with(
      "Of the equilibria found none bears more than the loads at 1.2 s of 2 s. The joint forces carry"))
      << reason_for_verdict(e);
  e.times = {0.0, 0.6};
  EXPECT_EQ(margin_answer(e).name, "End of the path") << "still growing";
}

// Readers of a screen hear the title first: a case without one lends the name of its file.
TEST(FirstScreen, EveryReportHasATitle) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.scene.title.clear();
  e.scene.file = "cases/my_dome.yaml";
  ReportInput input{};
  input.evaluation = &e;
  const std::string html = report_html(input);
  EXPECT_NE(html.find("<title>my_dome</title>"), std::string::npos);
  EXPECT_NE(html.find("<h1>my_dome</h1>"), std::string::npos);
}

// The lowest of three blocks has lost its joint with the two above, which hang in the air and fall.
TEST(FirstScreen, SaysWhichPartMoves) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
  Frame parted = frame;
  for (int i = 0; i < frame.contacts.size(); ++i) {
    if (frame.contacts.block_b[i] != 2) continue;
    parted.contacts.gap[i] = 0.1;
    parted.contacts.force[i].setZero();
    parted.contacts.normal_force[i] = 0.0;
    parted.contacts.slip[i] = std::numeric_limits<double>::quiet_NaN();
  }
  for (const size_t b : {2u, 3u}) parted.blocks.velocity[b] = Vec3(0, 0, -1);
  Summary summary = test::column_summary(a);
  summary.status = Status::moving;
  const Evaluation e =
      test::evaluated(a, {parted}, summary, test::column_case(), test::fresh_folder("parted"));
  EXPECT_EQ(e.parts, (std::vector<int>{-1, 1, 0, 0}));
  EXPECT_EQ(parts_sentence(e),
            "Of 2 unconnected parts one moves (2 blocks); the others, 1 block, are at rest.");
  EXPECT_EQ(verdict_words(e).words, "It falls");

  // The same as two stages of a construction that has not laid the uppermost block yet.
  parted.blocks.velocity[3] = Vec3::Zero();
  summary.analysis = AnalysisType::staged;
  summary.critical = CriticalValue{"fresh cohesion", 1000.0, 1010.0, 990.0};
  const Evaluation built =
      test::evaluated(a, {parted, parted}, summary, test::column_case(), test::fresh_folder("built"));
  ASSERT_EQ(built.last.frame.role, FrameRole::failed_stage);
  EXPECT_EQ(parts_sentence(built), "");
  EXPECT_EQ(how_it_gives_way(built), "") << "each stage has its own way";
  EXPECT_TRUE(certain_sentence(built).starts_with("It is proven of at least one stage that no forces"))
      << certain_sentence(built);
  EXPECT_TRUE(motion_numbers(built, {})[0].detail().ends_with("they form 1 body"))
      << motion_numbers(built, {})[0].detail();
}

// The column stands on 1.2 m of support, 0.8 m thick.
TEST(FirstScreen, ReactionsPerMetreOfSupport) {
  const Evaluation e = test::column_evaluation(0.6, 0.4);
  ASSERT_EQ(e.reactions.size(), 1u);
  EXPECT_NEAR(e.reactions[0].force.z(), -e.summary.weight_N, 1e-9 * e.summary.weight_N);
  EXPECT_NEAR(e.reactions[0].length, 1.2, 1e-12);
}

TEST(FirstScreen, ARangeAnalysisGivesTheRangeInPlaceOfTheChosenThrust) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  ForceRange range{.quantity = "thrust", .unit = "N", .min = {}, .max = {}, .chosen = 2e7};
  range.min = {RangeOutcome::bounded, 1.25e7, 1.25e7, {}};
  range.max = {RangeOutcome::unbounded, {}, {}, {}};
  e.summary.ranges = {range};
  const std::vector<KeyNumber> numbers = key_numbers(e, {});
  ASSERT_GE(numbers.size(), 1u);
  EXPECT_EQ(numbers[0].name, "Outward thrust");
  EXPECT_EQ(numbers[0].value, "12.5 to ∞ MN");
  EXPECT_NE(numbers[0].detail().find("the stiffness of the joints selects 20 MN"), std::string::npos);
}

// Three blocks of which the upper two moved by 0.8 m; the threshold of 0.5 m was passed at 1.26 s.
TEST(FirstScreen, AMotionBeginsWithHowFarAndWhen) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.last.frame.role = FrameRole::step;
  e.summary.status = Status::collapsed;
  e.last.frame.blocks.displacement[2] = Vec3(0.8, 0, 0);
  std::vector<HistoryRow> history;
  for (int i = 0; i <= 100; ++i) history.push_back({0.02 * i, 0.008 * i, 0.4, 0.0});
  const std::vector<KeyNumber> numbers = key_numbers(e, history);
  ASSERT_EQ(numbers.size(), 4u);
  EXPECT_EQ(numbers[0].value, "none") << "the margin";
  EXPECT_TRUE(numbers[0].detail().starts_with("it is in motion at its end; to compute"))
      << numbers[0].detail();
  EXPECT_EQ(numbers[1].value, "800 mm");
  EXPECT_EQ(numbers[2].value, "at 1.26 s");
  EXPECT_EQ(numbers[3].value, "0.4 m/s");
}

TEST(FirstScreen, StandsBeforeTheFirstHeadingAndEndsWithTheWorstJoints) {
  const Evaluation e = test::column_evaluation(0.3, 0.4);
  const std::string html = first_screen(e, {}, nullptr, "<section id=\"view\"></section>");
  const size_t verdict = html.find("class=\"verdict\""), numbers = html.find("key-numbers"),
               view = html.find("id=\"view\""), worst = html.find("Worst joints");
  EXPECT_LT(verdict, numbers);
  EXPECT_LT(numbers, view);
  EXPECT_LT(view, worst);
  EXPECT_NE(html.find("data-joint="), std::string::npos);
}

// Beds of joints with strength, pressed at an edge: pressure and use come before thrust line and friction.
TEST(FirstScreen, LeadsWithThePressureOverTheStrength) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 1.2, 0.4);
  const double strength = 1e5;  // Pa
  for (int i = 0; i < frame.contacts.size(); ++i)
    frame.contacts.strength_use.push_back(frame.contacts.normal_force[i] / frame.contacts.area[i] / strength);
  frame.contacts.friction_limit = frame.contacts.normal_force;
  frame.contacts.damage.assign(frame.contacts.strength_use.size(), 0.0);
  frame.contacts.crack_opening.assign(frame.contacts.strength_use.size(), 0.0);
  const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                       test::fresh_folder("pressed"));
  const std::vector<KeyNumber> numbers = key_numbers(e, {});
  ASSERT_GE(numbers.size(), 2u);
  EXPECT_EQ(numbers[1].name, kLargestPressure);
  const double pressure = 3 * 0.48 * 1800.0 * test::kGravity / 0.48;  // half of the lowest bed
  EXPECT_EQ(numbers[1].value, fmt::format("{:.3g} kPa", 1e-3 * pressure)) << "below 0.1 MPa";
  EXPECT_NE(numbers[1].detail().find(fmt::format("{:.3g} %", 100 * pressure / strength)), std::string::npos)
      << numbers[1].detail();
}

}  // namespace
}  // namespace cupola::first_screen_test
