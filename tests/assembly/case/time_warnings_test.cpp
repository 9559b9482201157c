// Records of the ground, pulses and times that an analysis leaves out or that a user would not have meant.

#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/case/case_times.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::time_warnings_test {
namespace {

TEST(ImplausibleRecords, AccelerogramsInOtherUnits) {
  const ScratchFolder scratch;
  scratch.write("quake.csv", "0, 0\n1, 0.08\n2, 0\n3, -0.08\n4, 0\n");
  const std::string motion =
      "extends: cupola:dome_circular\nanalysis: {type: dynamic}\n"
      "supports: {base_motion: {file: quake.csv, quantity: ";
  const auto warnings = [&](const std::string& rest) {
    return read_case(scratch.write("quake.yaml", motion + rest + "}}\n")).warnings;
  };
  ASSERT_EQ(warnings("acceleration").size(), 1u);
  EXPECT_EQ(warnings("acceleration").front(),
            "supports.base_motion (largest acceleration) = 0.08 m/s2: 0.1 to 50 m/s2 expected; in g? "
            "Multiply direction by 9.81");
  EXPECT_TRUE(warnings("acceleration, direction: [9.81, 0, 0]").empty());
  EXPECT_EQ(warnings("acceleration, direction: [981, 0, 0]").size(), 1u);
  EXPECT_TRUE(warnings("displacement").empty());
  EXPECT_EQ(warnings("displacement, direction: [1000, 0, 0]").size(), 1u);
}

// A pulse of 1 m/s2 for half a second, with and without one that brings the ground back to rest.
TEST(ImplausibleRecords, AccelerogramsThatEndInMotion) {
  const ScratchFolder scratch;
  const auto warnings = [&](const std::string& record) {
    scratch.write("quake.csv", record);
    return read_case(scratch.write("quake.yaml",
                                   "extends: cupola:arch\nanalysis: {type: dynamic}\nsupports: "
                                   "{base_motion: {file: quake.csv, quantity: acceleration}}\n"))
        .warnings;
  };
  EXPECT_TRUE(warnings("0, 0\n0.5, 1\n1, 0\n1.5, -1\n2, 0\n").empty());
  const std::vector<std::string> ends_fast = warnings("0, 0\n0.5, 1\n1, 0\n");
  ASSERT_EQ(ends_fast.size(), 1u);
  EXPECT_TRUE(
      ends_fast[0].starts_with("supports.base_motion (velocity at the end) = 0.5 m/s: at most 0.025 "
                               "m/s expected; the ground keeps this velocity after the end of "))
      << ends_fast[0];
}

// A sway of the ground of 1 Hz, cut out at full speed or where it rests.
TEST(ImplausibleRecords, DisplacementsThatStartOrEndInMotion) {
  const ScratchFolder scratch;
  const auto warnings = [&](double first, double last) {
    std::ostringstream record;
    for (int i = 0; i <= 50; ++i)
      record << 0.02 * i << ", " << 0.1 * std::cos(6.283 * (first + (last - first) * i / 50)) << "\n";
    scratch.write("quake.csv", record.str());
    return read_case(scratch.write("quake.yaml",
                                   "extends: cupola:arch\nanalysis: {type: dynamic}\nsupports: "
                                   "{base_motion: {file: quake.csv}}\n"))
        .warnings;
  };
  EXPECT_TRUE(warnings(0.0, 1.0).empty());
  for (const auto& cut : {warnings(0.25, 1.0), warnings(0.0, 0.75)}) {
    ASSERT_EQ(cut.size(), 1u);
    EXPECT_TRUE(cut[0].starts_with("supports.base_motion (acceleration at an end) = ")) << cut[0];
    EXPECT_NE(cut[0].find("quake.csv starts or ends at speed"), std::string::npos) << cut[0];
  }
}

// A motion lasts 4 s longer than what it follows, and says what it leaves out.
TEST(MissedChanges, OfRecordsLongerThanTheMotion) {
  const ScratchFolder scratch;
  scratch.write("quake.csv", "0, 0\n5, 0\n6, 0.1\n12, 0\n15, 0\n");
  const auto read = [&](const std::string& analysis) {
    return read_case(scratch.write("quake.yaml",
                                   "extends: cupola:arch\nsupports: {base_motion: {file: quake.csv}}\n"
                                   "analysis: {type: " +
                                       analysis + "}\n"));
  };
  EXPECT_EQ(read("dynamic").analysis.duration, 16.0);
  EXPECT_TRUE(read("dynamic").warnings.empty());
  EXPECT_TRUE(read("dynamic, duration: 12").warnings.empty());
  EXPECT_EQ(read("dynamic, duration: 4").warnings,
            std::vector<std::string>{
                "analysis.duration = 4 s ends before supports.base_motion (12 s): the answer is "
                "that up to 4 s; give 12 s or more"});
  EXPECT_EQ(read("path").warnings,
            std::vector<std::string>{
                "analysis.path.end = 1 s ends before supports.base_motion (12 s): the answer is "
                "that up to 1 s; give 12 s or more"});
  EXPECT_TRUE(read("path, path: {length: 0.01}").warnings.empty()) << "its length ends it";
}

// A blow of 6 ms in fixed steps of 10 ms. A sudden load that stays comes too late by half a step at most.
TEST(MissedChanges, OfPulsesShorterThanAStep) {
  const auto warnings = [](const std::string& values, const std::string& analysis) {
    return read_case(
               bundled_folder() + "/arch.yaml",
               {"loads.dead_load_time={type: table, times: [1, 1.001, 1.006, 1.007], values: " + values + "}",
                "analysis={type: dynamic" + analysis + "}"})
        .warnings;
  };
  EXPECT_EQ(warnings("[0, 1, 1, 0]", ""),
            std::vector<std::string>{
                "analysis.time_step = 0.01 s exceeds a pulse of loads.dead_load_time, 0.006 s, "
                "which steps may leave out; give a shorter one, or analysis.time_error"});
  EXPECT_TRUE(warnings("[0, 1, 1, 0]", ", time_step: 0.005").empty());
  EXPECT_TRUE(warnings("[0, 1, 1, 0]", ", time_error: 1e-5").empty());
  EXPECT_TRUE(warnings("[0, 1, 1, 1.5]", "").empty());
  EXPECT_TRUE(warnings("[0, 1, 1, 0.99]", "").empty()) << "noise";
}

// A support that is elsewhere one step later.
TEST(MissedChanges, OfSupportsThatJump) {
  const auto warnings = [](const std::string& time, const std::string& analysis) {
    return read_case(bundled_folder() + "/arch.yaml",
                     {"supports.moves=[{blocks: [0], displacement: [0.01, 0, 0], time: {" + time + "}}]",
                      "analysis={type: dynamic, duration: 3" + analysis + "}"})
        .warnings;
  };
  const std::vector<std::string> jump{
      "supports.moves[0].time: jumps within a step at 1 s, and throws what stands on the support; let the "
      "motion begin at 0 and last several steps"};
  EXPECT_EQ(warnings("type: harmonic, phase_deg: 90, start: 1", ""), jump);
  EXPECT_EQ(warnings("type: harmonic, phase_deg: 90, start: 1", ", time_error: 1e-5"), jump);
  EXPECT_TRUE(warnings("type: harmonic, start: 1", "").empty());
  EXPECT_EQ(warnings("type: ramp, duration: 0.001, start: 1", ""), jump);
  EXPECT_TRUE(warnings("type: ramp, duration: 0.001, start: 1", ", time_error: 1e-5").empty());
  EXPECT_TRUE(warnings("type: ramp, duration: 0.1, start: 1", "").empty());
}

// The velocity of the ground rises and falls in 20 ms each. Noise of the acceleration hardly changes it.
TEST(MissedChanges, OfPulsesOfTheGround) {
  const ScratchFolder scratch;
  const auto warnings = [&](const std::string& record, const std::string& time_step) {
    scratch.write("quake.csv", record);
    return read_case(scratch.write("quake.yaml",
                                   "extends: cupola:arch\n"
                                   "supports: {base_motion: {file: quake.csv, quantity: acceleration}}\n"
                                   "analysis: {type: dynamic, time_step: " +
                                       time_step + "}\n"))
        .warnings;
  };
  const std::string pulse =
      "0, 0\n0.01, 5\n0.02, 0\n0.03, -5\n0.04, 0\n0.05, 5\n0.06, 0\n0.07, -5\n0.08, 0\n";
  EXPECT_EQ(
      warnings(pulse, "0.04"),
      std::vector<std::string>{"analysis.time_step = 0.04 s exceeds a pulse of supports.base_motion, 0.02 s, "
                               "which steps may leave out; give a shorter one, or analysis.time_error"});
  EXPECT_TRUE(warnings(pulse, "0.01").empty());
  EXPECT_TRUE(warnings("0, 0\n0.5, 1\n0.51, 1.2\n0.52, 0.9\n1.5, -1\n1.945, 0\n", "0.04").empty());
}

// A path meets a wave of 1 Hz in each of ten or twenty steps when it is zero.
TEST(MissedChanges, OfPulsesWithLessThanTwoStepsOfAPath) {
  const auto warnings = [](const std::string& path) {
    return read_case(bundled_folder() + "/arch.yaml",
                     {"loads.dead_load_time={type: harmonic, phase_deg: 90}",
                      "analysis={type: path, path: {end: 10, " + path + "}}"})
        .warnings;
  };
  EXPECT_EQ(
      warnings("steps: 20"),
      std::vector<std::string>{"analysis.path.steps = 20: steps of 0.5 s exceed half a pulse of "
                               "loads.dead_load_time, 0.5 s, which they may leave out; give 40 or more"});
  EXPECT_TRUE(warnings("steps: 40").empty());
}

// All analyses but motions and paths take loads, supports and friction as they are at the time 0.
TEST(UnusedTimes, AreNamedWithTheirFactor) {
  const auto warnings = [](const std::vector<std::string>& options) {
    return read_case(bundled_folder() + "/arch.yaml", options).warnings;
  };
  const std::string ramp = "supports.moves=[{blocks: [0], displacement: [5e-3, 0, 0], time: {type: ramp}}]";
  const std::string wave = "loads.dead_load_time={type: harmonic, phase_deg: 90}";
  const std::vector<std::string> moves = warnings({"analysis={type: static}", ramp});
  ASSERT_EQ(moves.size(), 1u);
  EXPECT_TRUE(moves[0].starts_with(
      "supports.moves[0].time = 0 at the time 0: analysis.type: static leaves the rest of "
      "this movement out, and answers for the geometry as built;"))
      << moves[0];
  const std::vector<std::string> both =
      warnings({"analysis={type: static}", ramp, wave, "joints.friction_time={type: ramp, from: 1, to: 2}"});
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0], moves[0]);
  EXPECT_EQ(both[1],
            "loads.dead_load_time = 1, joints.friction_time = 1 at the time 0, which is all that "
            "analysis.type: static uses; leave this out for the full value, or use type: path");
  const std::vector<std::string> one =
      warnings({"analysis={type: range, range: {quantities: [thrust]}}", wave});
  ASSERT_EQ(one.size(), 1u);
  EXPECT_TRUE(one[0].starts_with(
      "loads.dead_load_time = 1 at the time 0, which is all that analysis.type: range uses;"))
      << one[0];
  EXPECT_TRUE(warnings({"analysis={type: path}", ramp}).empty());
  EXPECT_TRUE(warnings({"analysis={type: dynamic}", wave}).empty());
  EXPECT_TRUE(warnings({"analysis={type: limit, limit: {parameter: spread}}", ramp}).empty());
  EXPECT_TRUE(warnings({"analysis={type: static}", "joints.friction_time={type: ramp, from: 1}"}).empty());
}

}  // namespace
}  // namespace cupola::time_warnings_test
