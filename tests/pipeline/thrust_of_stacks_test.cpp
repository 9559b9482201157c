// Thrusts of arches and domes of which cuts have taken a part, and of several members, in tables and ranges.

#include <fstream>
#include <numbers>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/evaluation/thrust.hpp"
#include "postproc/figures/range_text.hpp"
#include "postproc/report/answers.hpp"
#include "tests/pipeline/static_run.hpp"
#include "tests/verification/thrust.hpp"

namespace cupola::thrust_of_stacks_test {
namespace {

Case read(const ProgramFolder& folder, const std::string& text) {
  std::ofstream(folder.file("case.yaml")) << text;
  return read_case(folder.file("case.yaml"));
}

ForceRange range_of_thrust(Case scene, const Assembly& assembly) {
  scene.analysis.type = AnalysisType::range;
  scene.analysis.range.quantities = {BaseThrust{}};
  return run_range(scene, assembly, {}).value().ranges.at(0);
}

// Half an arch leans on a wall, which is its other springing: both bear the same thrust, whichever half it is
// and wherever the wall stands. Walls at x >= 0 took the thrust of the springing away.
TEST(ThrustOfStacks, AHalfArchPushesOnItsWallAsOnItsSpringing) {
  std::vector<ForceRange> ranges;
  for (const double side : {1.0, -1.0}) {
    const ProgramFolder folder;
    const Case scene =
        read(folder,
             fmt::format(
                 "geometry:\n  surface: {{type: vault, plan: {{type: line, length: 0.6}}, profile: {{type: "
                 "semicircle, span: 8}}, thickness: 0.6}}\n  bond: {{type: stack, rings: 11, "
                 "blocks_per_ring: 1}}\n  cuts: [{{type: plane, point: [{}, 0, 0], normal: [{}, 0, 0], "
                 "as: held}}]\njoints: {{friction: 0.7, compliance: {{per: area}}}}\n",
                 0.2 * side, -side));
    const Evaluation e = solve_and_evaluate(scene, folder);
    ASSERT_TRUE(at_rest(e)) << e.summary.message;
    const std::vector<Thrust> thrusts = thrusts_of(e, e.assembly.sheets.front());
    ASSERT_EQ(thrusts.size(), 2u);
    const double rounding = 1e-8 * e.summary.weight_N;  // the solver's tolerance
    EXPECT_GT(thrusts[0].force, 0.1 * e.summary.weight_N);
    EXPECT_NEAR(thrusts[0].force, thrusts[1].force, rounding);
    for (const Reaction& r : e.reactions) EXPECT_NEAR(r.outward, thrusts[0].force, rounding);
    EXPECT_TRUE(thrust_answer(e)->detail().starts_with("at most ")) << thrust_answer(e)->detail();
    ranges.push_back(range_of_thrust(scene, e.assembly));
    EXPECT_LE(ranges.back().min.value.value(), thrusts[0].force + rounding);
    EXPECT_GE(ranges.back().max.value.value(), thrusts[0].force - rounding);
  }
  // The requested gap of a range, 1e-6 of its values, twice.
  EXPECT_NEAR(ranges[0].min.value.value() / ranges[1].min.value.value(), 1.0, 1e-5);
  EXPECT_NEAR(ranges[0].max.value.value() / ranges[1].max.value.value(), 1.0, 1e-5);
}

// Half a ring pulls with no force where it is cut off, and the wall there is no part of its bed.
TEST(ThrustOfStacks, HalfADomeHasNoHoopTensionOfAWholeOne) {
  for (const bool half : {false, true}) {
    const ProgramFolder folder;
    const Evaluation e = solve_and_evaluate(
        read(folder,
             fmt::format(
                 "geometry:\n  surface: {{type: vault, plan: {{type: circle}}, profile: {{type: "
                 "semicircle, span: 6}}, thickness: 0.9, eye: 0.3}}\n  bond: {{type: running, rings: "
                 "6, blocks_per_ring: 12, slices_per_block: 2}}\n{}joints: {{friction: 0.7, "
                 "compliance: {{per: area}}}}\n",
                 half ? "  cuts: [{type: plane, point: [0, 0, 0], normal: [0, -1, 0], as: held}]\n" : "")),
        folder);
    ASSERT_TRUE(at_rest(e)) << e.summary.message;
    EXPECT_EQ(net_hoop_tension(e, -2.0 * std::numbers::pi).has_value(), !half);
    EXPECT_NEAR(e.rings.front().height, 0.0, 1e-9);  // m; the wall stands up to 3.9 m
  }
}

// Two arches beside each other, of which each has its thrust, by its name. The first screen leads with the one
// that may push more, as statics do, although it is not the last of the list.
TEST(ThrustOfStacks, ARangeOfTheThrustIsThatOfEachStack) {
  const ProgramFolder folder;
  const auto arch = [](double span) {
    return fmt::format(
        "surface: {{type: arch, span: {}, radius_ratio: 0.6, thickness: 0.4, width: 1}}, bond: {{type: "
        "stack, rings: 10, blocks_per_ring: 1}}",
        span);
  };
  const Case both =
      read(folder,
           fmt::format("geometry: {{members: [{{name: large, {}}}, {{name: small, at: {{origin: [9, 0, 0]}}, "
                       "{}}}]}}\njoints: {{friction: 0.7, compliance: {{per: area}}}}\n",
                       arch(5.0), arch(4.0)));
  Case scene = both;
  scene.analysis.type = AnalysisType::range;
  scene.analysis.range.quantities = {BaseThrust{}};
  Evaluation e = solve_and_evaluate(both, folder);
  e.summary.ranges = run_range(scene, e.assembly, {}).value().ranges;
  ASSERT_EQ(e.summary.ranges.size(), 2u);
  EXPECT_EQ(e.summary.ranges[0].quantity, "thrust of small");
  EXPECT_EQ(e.summary.ranges[1].quantity, "thrust of large");
  const ProgramFolder alone_folder;
  const Case alone = read(alone_folder, fmt::format("geometry: {{{}}}\njoints: {{friction: 0.7, compliance: "
                                                    "{{per: area}}}}\n",
                                                    arch(4.0)));
  const ForceRange small = range_of_thrust(alone, generate(alone));
  // The requested gap of a range, 1e-6 of its values, twice.
  EXPECT_NEAR(e.summary.ranges[0].min.value.value() / small.min.value.value(), 1.0, 1e-5);
  EXPECT_NEAR(e.summary.ranges[0].max.value.value() / small.max.value.value(), 1.0, 1e-5);
  const ForceRange& large = e.summary.ranges[1];
  EXPECT_EQ(thrust_answer(e)->value, range_ends(large));
  const std::string detail = thrust_answer(e)->detail();
  EXPECT_NE(detail.find("; of large; "), std::string::npos) << detail;
  EXPECT_NE(detail.find("; of small "), std::string::npos) << detail;
}

// Walls on the jambs of an arch lean on each other beside it: their supports bear more than its thrust, and
// the first screen says what. Without these walls the supports bear the thrust alone, which is not repeated.
TEST(ThrustOfStacks, WhatPushesBesideAnArchIsNamed) {
  for (const bool has_walls : {true, false}) {
    const ProgramFolder folder;
    const Evaluation e = solve_and_evaluate(
        read(
            folder,
            fmt::format(
                "geometry:\n  members:\n"
                "    - name: jamb\n      at: {{origin: [-2, 0, 0]}}\n"
                "      mirror: {{point: [0, 0, 0], normal: [1, 0, 0]}}\n"
                "      surface: {{type: wall, length: 1, height: 1, thickness: 0.5}}\n"
                "      bond: {{type: stack, rings: 2, blocks_per_ring: 1}}\n{}"
                "    - name: ring\n      on: jamb\n      at: {{origin: [0, 0, 0]}}\n"
                "      surface: {{type: vault, plan: {{type: line, length: 0.5}}, profile: {{type: "
                "semicircle, "
                "span: 2}}, thickness: 0.3}}\n      bond: {{type: stack, rings: 9, blocks_per_ring: 1}}\n"
                "joints: {{friction: 0.6, compliance: {{per: area}}}}\n",
                has_walls ? "    - name: upper\n      on: jamb\n"
                            "      surface: {type: wall, length: 2, height: 2, thickness: 0.5}\n"
                            "      bond: {type: running, rings: 6, blocks_per_ring: 3, slices_per_block: 2}\n"
                            "      cuts: [{type: under, member: ring}]\n"
                          : "")),
        folder);
    ASSERT_TRUE(at_rest(e)) << e.summary.message;
    const std::string detail = thrust_answer(e)->detail();
    const std::string borne = fmt::format("; the supports bear outwards {} on each of 2 supports",
                                          force_text(e.reactions[0].outward));
    EXPECT_EQ(detail.find(borne) != std::string::npos, has_walls) << detail;
    EXPECT_EQ(detail.find("bear outwards") != std::string::npos, has_walls) << detail;
  }
}

// The middle buttresses of an aisle bear two bays, whose pushes along the aisle balance there. Outwards is the
// diagonal of one bay; across the aisle they bear 24.5 kN, a sixth more, and the first screen says so.
TEST(ThrustOfStacks, APierUnderTwoVaultsBearsMoreThanItsOutwardForce) {
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(read_case(bundled_folder() + "/groin_aisle.yaml"), folder);
  ASSERT_TRUE(at_rest(e)) << e.summary.message;
  double outward = 0.0, horizontal = 0.0;
  for (const Reaction& r : e.reactions) {
    outward = std::max(outward, r.outward);
    horizontal = std::max(horizontal, r.force.head<2>().norm());
  }
  EXPECT_GT(horizontal, 1.1 * outward);
  const std::string detail = thrust_answer(e)->detail();
  EXPECT_NE(detail.find(", horizontally up to " + force_text(horizontal)), std::string::npos) << detail;
}

// The supports of a tied arch bear its thrust less what the tie pulls: the first screen says that it counts
// the joints alone.
TEST(ThrustOfStacks, OfATiedArchIsThatOfItsJoints) {
  for (const bool tied : {false, true}) {
    const ProgramFolder folder;
    const Evaluation e = solve_and_evaluate(
        read(folder,
             fmt::format("geometry:\n  surface: {{type: arch, span: 6, radius_ratio: 0.5, thickness: 0.6, "
                         "width: 1}}\n  bond: {{type: stack, rings: 11, blocks_per_ring: 1}}\n{}joints: "
                         "{{friction: 0.7, compliance: {{per: area}}}}\n",
                         tied ? "ties: {pairs: [{block_a: 2, block_b: 10, point_a: [3.1, 0, 1.2], point_b: "
                                "[-3.1, 0, 1.2], stiffness: 1e7, prestress: 1000}]}\n"
                              : "")),
        folder);
    ASSERT_TRUE(at_rest(e)) << e.summary.message;
    const std::string detail = thrust_answer(e)->detail();
    EXPECT_EQ(detail.find("of the joints alone") != std::string::npos, tied) << detail;
    if (!tied) continue;
    const std::string tie = force_text(e.last.frame.ties.force.at(0));
    EXPECT_NE(detail.find("; of the joints alone; a tie or restraint carries up to " + tie),
              std::string::npos)
        << detail;
  }
}

}  // namespace
}  // namespace cupola::thrust_of_stacks_test
