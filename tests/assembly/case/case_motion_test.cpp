#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/files/time_table.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::case_motion_test {
namespace {

const char* const kWall = R"(geometry:
  surface: {type: wall, length: 3}
  bond: {type: running, rings: 2, blocks_per_ring: 2}
)";

TEST(ReadMotion, ReadsJointLawsPerKindAndRing) {
  const ScratchFolder scratch;
  const Case c = read_case(scratch.write("a.yaml", std::string(kWall) + R"(joints:
  compliance: {per: point}
  bed: {friction: 0.3}
  herringbone: {normal: 2e-8}
  rings:
    - {from: 3, friction: 0.1}
    - {from: 1, to: 2, kind: head, tangential: 1e-7}
  friction_time: {type: ramp, from: 1, to: 0.5, duration: 2}
)"));
  EXPECT_EQ(c.joints.bed->friction, 0.3);
  EXPECT_FALSE(c.joints.bed->normal);
  EXPECT_FALSE(c.joints.head);
  EXPECT_EQ(c.joints.herringbone->normal, 2e-8);
  ASSERT_EQ(c.joints.rings.size(), 2u);
  EXPECT_EQ(c.joints.rings[0].to, 3);
  EXPECT_EQ(c.joints.rings[0].law.friction, 0.1);
  EXPECT_EQ(c.joints.rings[1].sort, RingJoints::Sort::head);
  EXPECT_DOUBLE_EQ(factor_at(c.joints.friction_time, 1.0), 0.75);
}

TEST(ReadMotion, RefusesFrictionBelowZero) {
  const ScratchFolder scratch;
  const auto read = [&](const std::string& time) {
    return read_case(scratch.write("a.yaml", std::string(kWall) +
                                                 "joints: {compliance: {per: point}, friction_time: " + time +
                                                 "}\nanalysis: {type: dynamic}\n"));
  };
  EXPECT_THROW(read("{type: harmonic}"), InputError);
  EXPECT_THROW(read("{type: ramp, from: 1, to: -0.5}"), InputError);
  EXPECT_THROW(read("{type: table, times: [0, 1, 2], values: [1, -0.1, 1]}"), InputError);
  EXPECT_NO_THROW(read("{type: table, times: [0, 1, 2], values: [1, 0, 1]}"));
}

TEST(ReadMotion, ReadsLoadsTiesAndSupports) {
  const ScratchFolder scratch;
  scratch.write("shake.csv", "0 0\n1 2\n");
  const Case c = read_case(scratch.write("a.yaml", std::string(kWall) + R"(joints: {compliance: {per: point}}
loads:
  dead_load_time: {type: ramp, duration: 2}
  forces: [{block: 3, point: [1, 2, 3], force: [0, 0, -5], time: {type: harmonic, frequency: 0.25}}]
  faces: [{kind: extrados, from_ring: 1, pressure: 500}]
ties:
  pairs: [{block_a: 1, block_b: 2, stiffness: 1e6, prestress: 10}, {block_a: 1, block_b: 2, slack: 0.01, yield_force: 5e3}]
supports:
  base_motion: {file: shake.csv, direction: [0, 1, 0]}
  moves: [{blocks: [0], displacement: [0.1, 0, 0], time: {type: table, times: [0, 2], values: [0, 1]}}]
analysis: {type: dynamic, start: static, time_error: 1e-5, adaptive: {largest: 0.02}, stop: {settled_time: 0.5}}
)"));
  EXPECT_DOUBLE_EQ(factor_at(c.loads.dead_load_time, 1.0), 0.5);
  EXPECT_EQ(*c.loads.forces[0].point, Vec3(1, 2, 3));
  EXPECT_NEAR(factor_at(c.loads.forces[0].time, 1.0), 1.0, 1e-15);
  EXPECT_EQ(c.loads.faces[0].pressure, 500.0);
  EXPECT_EQ(c.ties.pairs[0].prestress, 10.0);
  EXPECT_FALSE(c.ties.pairs[0].yield_force.has_value());
  EXPECT_EQ(c.ties.pairs[1].slack, 0.01);
  EXPECT_EQ(c.ties.pairs[1].yield_force, 5e3);
  EXPECT_EQ(read_time_table(c.supports.base_motion->file).values[1], 2.0);
  EXPECT_DOUBLE_EQ(factor_at(c.supports.moves[0].time, 1.0), 0.5);
  EXPECT_EQ(c.analysis.start, Analysis::Start::static_);
  EXPECT_EQ(c.analysis.adaptive->largest, 0.02);
  EXPECT_EQ(c.analysis.adaptive->displacement_error, 1e-5);
  EXPECT_EQ(c.analysis.stop.settled_time, 0.5);
}

/// The options written to run.yaml describe the same case.
TEST(ReadMotion, EffectiveOptionsReadBackAsTheSameCase) {
  const ScratchFolder scratch;
  const Case c = read_case(scratch.write(
      "a.yaml", std::string(kWall) + R"(joints: {compliance: {per: point}, base: {friction: 0.7}}
loads: {forces: [{block: 3, force: [0, 0, -5]}]}
supports: {moves: [{displacement: [0.1, 0, 0]}]}
)"));
  const Case again = read_case(scratch.write("b.yaml", c.effective_yaml));
  EXPECT_EQ(again.effective_yaml, c.effective_yaml);
  EXPECT_EQ(again.hash, c.hash);
}

struct BadMotion {
  const char* text;
  const char* phrase;
};

TEST(ReadMotion, ErrorsNameTheBrokenRule) {
  const ScratchFolder scratch;
  scratch.write("bad.csv", "0 0\n0 1\n");
  scratch.write("good.csv", "0 0\n1 1\n");
  scratch.write("early.csv", "-1 0\n0 1\n1 0\n");
  for (const BadMotion& bad : std::initializer_list<BadMotion>{
           {"supports: {base_motion: {file: absent.csv}}", "no such file"},
           {"supports: {base_motion: {quantity: displacement}}", "supports.base_motion.file: must be given"},
           {"supports: {base_motion: {file: early.csv, quantity: acceleration}}",
            "its first time is -1 s. Accelerations are"},
           {"loads: {gravity: [0, 0, 0]}\nanalysis: {robustness: 8}",
            "must be vertical, within 30 degrees, and not 0"},
           {"supports: {moves: [{time: {type: table, file: bad.csv}}]}", "times must increase"},
           {"supports: {moves: [{time: {type: table, times: [0, 0], values: [1, 2]}}]}", "must increase"},
           {"loads: {dead_load_time: {type: table, file: good.csv, times: [0, 5], values: [7, 7]}}",
            "loads.dead_load_time.file = good.csv: gives the points: remove `times` and `values`"},
           {"supports: {moves: [{displacement: [0, 0, -1]}]}\nanalysis: {type: path}",
            "nothing changes with time, as analysis.type: path requires; give supports.moves[0].time: {type: "
            "ramp}"},
           {"supports: {moves: [{blocks: [0.5]}]}", "must be a whole number"},
           {"loads: {forces: [{force: [0, 0, 1]}]}",
            "loads.forces[0].block: give the loaded block, a point or `over`"},
           {"loads: {forces: [{block: 1, over: {course: 0}, force: [0, 0, 1]}]}",
            "over = {...}: shares the force"},
           {"loads: {forces: [{over: {course: 0}, moment: [0, 0, 1]}]}", "acts on one block: give `block`"},
           {"loads: {lantern: {weight: 1000, mass: 100}}",
            "give one of weight_fraction, weight (N) and mass (kg)"},
           {"ties: {pairs: [{block_a: 1, block_b: 2, stiffness: 0}]}",
            "ties.pairs[0].stiffness = 0: must be > 0"},
           {"ties: {pairs: [{block_a: 1, block_b: 2, prestress: 5000, yield_force: 1000}]}",
            "ties.pairs[0].prestress = 5000: must be <= yield_force"},
           {"analysis: {time_error: 1e-4, adaptive: {smallest: 1, largest: 0.1}}", "must be >= smallest"},
           {"analysis: {adaptive: {smallest: 1e-4}}", "requires time_error"},
           {"analysis: {integrator: generalized_alpha}", "applies to dynamic analyses only"},
           {"analysis: {recovery: literal}", "literal applies to dynamic analyses only"},
           {"analysis: {type: dynamic, integrator: generalized_alpha, recovery: literal}",
            "literal is a scheme of implicit Euler"},
           {"analysis: {type: dynamic, recovery: litteral}", "literal"},
           {"analysis: {type: dynamic, integrator: generalized_alpha, tangential: literal}",
            "literal is a scheme of implicit Euler"}}) {
    try {
      read_case(
          scratch.write("a.yaml", std::string(kWall) + "joints: {compliance: {per: point}}\n" + bad.text));
      ADD_FAILURE() << bad.text << " was accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(bad.phrase), std::string::npos) << error.what();
    }
  }
}

// Level directions, as the default is, serve gravity that is a little inclined; run.yaml writes them out.
TEST(ReadMotion, LevelPullsServeInclinedGravity) {
  const ScratchFolder scratch;
  const std::string path =
      scratch.write("wall.yaml", std::string(kWall) + "joints: {compliance: {per: point}}\n");
  const auto read = [&](const std::string& gravity, const std::string& direction) {
    std::vector<std::string> set = {"analysis.type=limit", "analysis.limit.parameter=acceleration",
                                    "loads.gravity=" + gravity};
    if (!direction.empty()) set.push_back("analysis.limit.direction=" + direction);
    return read_case(path, set);
  };
  const Case c = read("[0.05, 0, -9.81]", "");
  EXPECT_NO_THROW(read_case(scratch.write("again.yaml", c.effective_yaml)));
  EXPECT_NO_THROW(read("[0.05, 0, -9.81]", "[9.81, 0, 0.05]")) << "at right angles";
  EXPECT_THROW(read("[0, 0, -9.81]", "[1, 0, 0.05]"), InputError);
  EXPECT_THROW(read("[9.81, 0, -1]", ""), InputError) << "gravity itself";
}

}  // namespace
}  // namespace cupola::case_motion_test
