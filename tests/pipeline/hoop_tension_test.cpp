// The range of the thrust of a dome, whose courses may hold each other by the friction of their bond.

#include <algorithm>
#include <fstream>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "assembly/case/case_reader.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/report/answers.hpp"
#include "tests/pipeline/static_run.hpp"

namespace cupola::hoop_tension_test {
namespace {

Evaluation range_of_thrust(const std::string& shape, const std::string& bond, bool states = true) {
  const ProgramFolder folder;
  std::ofstream(folder.file("case.yaml")) << fmt::format(
      "geometry:\n"
      "  surface: {{type: vault, plan: {{type: circle}}, {}, thickness: 0.6}}\n"
      "  bond: {{type: {}, rings: 6, blocks_per_ring: 12}}\n"
      "joints: {{friction: 0.6, compliance: {{per: area}}}}\n"
      "analysis: {{type: range, range: {{quantities: [thrust], states: {}}}}}\n",
      shape, bond, states);
  const Case scene = read_case(folder.file("case.yaml"));
  const Assembly assembly = generate(scene);
  ResultsWriter writer(folder.file("results"), content_hash(assembly));
  Summary summary = run_range(scene, assembly,
                              {[&writer](const Frame& frame) { writer.write_frame(frame); },
                               [](const std::string&) {}, [](const std::string&) {}})
                        .value();
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  summary.assembly_hash = content_hash(assembly);
  summary.geometry_hash = scene.geometry_hash;
  summary.case_hash = scene.hash;
  writer.write_summary(summary);
  return evaluate(scene, assembly, ResultsReader(folder.file("results"), content_hash(assembly)));
}

// Courses of running bond hold tension by friction on the beds of their neighbours; aligned head joints
// cannot, and their range does not count on it.
TEST(HoopTension, ARangeThatCountsOnItSaysSo) {
  const char* dome = "profile: {type: semicircle, span: 6}, eye: 0.6";
  const std::vector<std::string> running = range_of_thrust(dome, "running").warnings,
                                 stack = range_of_thrust(dome, "stack").warnings;
  ASSERT_EQ(running.size(), 1u);
  EXPECT_TRUE(running[0].starts_with("the range of the thrust counts on hoop tension: at its least end"))
      << running[0];
  EXPECT_EQ(stack, std::vector<std::string>());
}

// Radial equilibrium of a drum that only weighs: an inward thrust is 2 pi times the tension in its rings.
TEST(HoopTension, AnInwardThrustOfRingsIsTheirPull) {
  const char* drum = "profile: {type: straight, span: 6, height: 2}";
  const Evaluation running = range_of_thrust(drum, "running"), stack = range_of_thrust(drum, "stack");
  const double least = running.summary.ranges.at(0).min.value.value();
  ASSERT_LT(least, 0.0);
  const std::string net = force_text(-least / (2.0 * std::numbers::pi));
  const std::string pull = "a hoop tension of " + net + " net of compression,";
  EXPECT_NE(thrust_answer(running)->detail().find(pull), std::string::npos)
      << thrust_answer(running)->detail();
  EXPECT_EQ(thrust_answer(stack)->detail().find("hoop tension"), std::string::npos)
      << thrust_answer(stack)->detail();
  EXPECT_TRUE(thrust_answer(running)->detail().ends_with("try `bond: {type: stack}`"));
  const std::vector<std::string> without_states = range_of_thrust(drum, "running", false).warnings;
  ASSERT_EQ(without_states.size(), 1u);
  EXPECT_NE(without_states[0].find("at its least end the courses carry at least " + net), std::string::npos)
      << without_states[0];
  Evaluation on_a_drum = running;  // of a dome in stack bond, which needs no advice
  Geometry& geometry = on_a_drum.scene.geometry;
  geometry.members = {geometry};
  geometry.members[0].name = "drum";
  geometry.bond = StackBond{};
  EXPECT_TRUE(thrust_answer(on_a_drum)->detail().ends_with("try `bond: {type: stack}` of drum"))
      << thrust_answer(on_a_drum)->detail();
}

}  // namespace
}  // namespace cupola::hoop_tension_test
