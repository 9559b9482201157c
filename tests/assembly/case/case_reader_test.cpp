#include "assembly/case/case_reader.hpp"

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::case_reader_test {
namespace {

const char* const kDome = R"(title: "A dome: 40 x 32"
geometry:
  surface: {type: dome, span: 45, thickness: 2.2}
  bond: {type: running, rings: 40, blocks_per_ring: 32}
joints:
  friction: 0.3
  compliance: {normal: 1e-8, tangential: 2e-8, per: point}
loads: {gravity: [0, 0, -9.80665], lantern: {weight_fraction: 0.02}}
postproc:
  meridians: [{name: east, azimuth_deg: 0}]
  sections: [14.5, 22.5]
)";

const char* const kWall = R"(geometry:
  surface: {type: wall, length: 3}
  bond: {type: running, rings: 2, blocks_per_ring: 2}
joints: {compliance: {per: area}}
)";

TEST(ReadCase, ReadsEveryValueOfTheFile) {
  const ScratchFolder scratch;
  const Case c = read_case(scratch.write("dome.yaml", kDome));
  EXPECT_EQ(c.title, "A dome: 40 x 32");
  const auto& dome = std::get<DomeSurface>(c.geometry.surface);
  EXPECT_EQ(dome.span, 45.0);
  EXPECT_EQ(dome.thickness, 2.2);
  EXPECT_EQ(std::get<RunningBond>(c.geometry.bond).rings, 40);
  EXPECT_EQ(c.joints.friction, 0.3);
  EXPECT_EQ(c.joints.compliance.tangential, 2e-8);
  EXPECT_EQ(c.joints.compliance.per, Compliance::Per::point);
  EXPECT_EQ(c.loads.gravity.z(), -9.80665);
  ASSERT_TRUE(c.loads.lantern);
  EXPECT_EQ(c.loads.lantern->weight_fraction, 0.02);
  EXPECT_FALSE(c.loads.top_load);
  ASSERT_EQ(c.postproc.meridians.size(), 1u);
  EXPECT_EQ(c.postproc.meridians[0].name, "east");
  EXPECT_EQ(c.postproc.sections, (std::vector<double>{14.5, 22.5}));
}

// The letters of a drawing are keys of `kinds`, and YAML has a meaning for many of them.
TEST(ReadCase, EveryLetterOfADrawingReadsBack) {
  const ScratchFolder scratch;
  for (char letter = '!'; letter <= '~'; ++letter) {
    if (letter == '.') continue;  // no block
    const std::string text = letter == '\'' ? "''" : std::string(1, letter);
    const Case c = read_case(scratch.write(
        "drawn.yaml",
        "geometry:\n  surface: {type: wall}\n  bond: {type: drawn, letter_length: 1, rows: ['z" + text +
            "'], kinds: {'" + text + "': flat}}\njoints: {compliance: {per: area}}\n"));
    const Case again = read_case(scratch.write("again.yaml", c.effective_yaml));
    EXPECT_EQ(again.effective_yaml, c.effective_yaml) << letter;
    EXPECT_EQ(std::get<DrawnBond>(again.geometry.bond).kinds,
              (std::vector{std::pair{letter, DrawnBond::LetterKind::flat}}));
  }
}

// A case whose title names a friction does not keep it silently when --set changes the friction.
TEST(ReadCase, TitleNamesWhatSetChanges) {
  const ScratchFolder scratch;
  const std::string path = scratch.write("dome.yaml", kDome);
  EXPECT_EQ(read_case(path, {"joints.friction=0.085", "postproc.sections=[1]"}).title,
            "A dome: 40 x 32 (with joints.friction=0.085)");
  EXPECT_EQ(read_case(path, {"title=B", "output.frames_every=0.1"}).title, "B");
}

TEST(ReadCase, QuantitiesOfARangeAreNamesOrMaps) {
  const ScratchFolder scratch;
  const Case c = read_case(
      scratch.write("range.yaml", kDome),
      {"analysis.type=range",
       "analysis.range.quantities=[thrust, {type: joint, blocks: [12, \"west 3\"], component: eccentricity, "
       "direction: [0, 0, 1]}, {type: ratio, of: ribs, over: {blocks: [4]}}]"});
  const std::vector<ForceQuantity>& quantities = c.analysis.range.quantities;
  ASSERT_EQ(quantities.size(), 3u);
  EXPECT_TRUE(std::holds_alternative<BaseThrust>(quantities[0]));
  const auto& joint = std::get<JointForce>(quantities[1]);
  EXPECT_EQ(joint.block_a.number, 12);
  EXPECT_EQ(joint.block_b.name, "west 3");
  EXPECT_EQ(joint.component, JointForce::Component::eccentricity);
  EXPECT_EQ(joint.direction, Eigen::Vector3d(0, 0, 1));
  const auto& ratio = std::get<BaseRatio>(quantities[2]);
  EXPECT_EQ(ratio.of.group, BaseBlocks::Group::ribs);
  EXPECT_EQ(ratio.over.group, BaseBlocks::Group::listed);
  EXPECT_EQ(ratio.over.blocks.size(), 1u);
  // run.yaml holds the values in force and reads back.
  const Case again = read_case(scratch.write("again.yaml", c.effective_yaml));
  EXPECT_EQ(again.effective_yaml, c.effective_yaml);
}

TEST(ReadCase, ReadsFreshMortarAndItsShortForm) {
  const ScratchFolder scratch;
  const std::string path = scratch.write("wall.yaml", kWall);
  const std::vector<std::string> block = {"analysis.type=staged", "analysis.friction_law=coulomb",
                                          "analysis.staged.unit=block", "analysis.staged.fresh_friction=0.25",
                                          "analysis.staged.fresh.cohesion=500"};
  const Case c = read_case(path, block);
  const StagedConstruction& staged = c.analysis.staged;
  EXPECT_EQ(staged.fresh.friction, 0.25);
  EXPECT_EQ(staged.fresh.cohesion, 500.0);
  EXPECT_FALSE(staged.fresh.normal);
  const Case again = read_case(scratch.write("again.yaml", c.effective_yaml));
  EXPECT_EQ(again.effective_yaml, c.effective_yaml);
  // The associated law jams open courses; it must be admitted.
  EXPECT_THROW(read_case(path, {"analysis.type=staged", "analysis.staged.unit=block"}), InputError);
  std::vector<std::string> given = block;
  given.insert(given.end(), {"analysis.staged.order=given", "analysis.staged.sequence=[r0_3, 7]"});
  const std::vector<BlockRef> sequence = read_case(path, given).analysis.staged.sequence;
  ASSERT_EQ(sequence.size(), 2u);
  EXPECT_EQ(sequence[0].name, "r0_3");
  EXPECT_EQ(sequence[1].number, 7);
  EXPECT_NO_THROW(read_case(
      path, {"analysis.type=staged", "analysis.staged.unit=block", "analysis.staged.allow_associated=true"}));
}

TEST(ReadCase, KeepsTheDefaultsOfTheStructs) {
  const ScratchFolder scratch;
  const Case c = read_case(scratch.write("wall.yaml", kWall));
  EXPECT_EQ(std::get<WallSurface>(c.geometry.surface).height, WallSurface{}.height);
  EXPECT_EQ(c.joints.friction, Joints{}.friction);
  EXPECT_EQ(c.analysis.time_step, Analysis{}.time_step);
  EXPECT_EQ(c.analysis.type, AnalysisType::static_);
  EXPECT_FALSE(c.geometry.stage);
}

TEST(ReadCase, StagesHaveAToleranceOfTheirOwnUnlessOneIsGiven) {
  const ScratchFolder scratch;
  const std::string path = scratch.write("wall.yaml", kWall);
  EXPECT_EQ(read_case(path, {"analysis.type=staged"}).analysis.tolerance, 1e-5);
  EXPECT_EQ(read_case(path, {"analysis.type=dynamic"}).analysis.tolerance, 1e-5);
  EXPECT_EQ(read_case(path, {"analysis.type=staged", "analysis.tolerance=1e-9"}).analysis.tolerance, 1e-9);
  EXPECT_EQ(read_case(path).analysis.tolerance, Analysis{}.tolerance);
}

TEST(ReadCase, LimitsOfScalesBeginAboveZeroUnlessLowIsGiven) {
  const ScratchFolder scratch;
  const auto low = [&](const std::string& keys) {
    return read_case(scratch.write("c.yaml", kWall + ("analysis: {type: limit, limit: {" + keys + "}}\n")))
        .analysis.limit.low;
  };
  EXPECT_EQ(low("parameter: friction"), 0.0);
  EXPECT_EQ(low("parameter: joint_extent"), 0.01);
  EXPECT_EQ(low("parameter: thickness, low: 0.5"), 0.5);
}

TEST(ReadCase, AnOutlineMayHaveACornerOnAStraightSide) {
  const ScratchFolder scratch;
  const auto read = [&](const std::string& outline) {
    read_case(scratch.write("c.yaml", kWall), {"geometry.cuts=[{type: prism, axis: y, " + outline + "}]"});
  };
  EXPECT_NO_THROW(read("u: [-0.5, 0, 0.5, 0], v: [2, 2, 2, 5]"));
  EXPECT_NO_THROW(read("u: [0, 0.5, 0.3, 0.1], v: [5, 2, 2, 2]")) << "clockwise";
  EXPECT_THROW(read("u: [0, 6, 1, 3, 5], v: [4, 4, 0, 6, 0]"), InputError)
      << "a star, which always turns left";
}

TEST(ReadCase, APresetSetsTheTolerance) {
  const ScratchFolder scratch;
  const std::string own = std::string(kWall) + "analysis: {tolerance: 1e-7}\n";
  EXPECT_EQ(read_case(scratch.write("own.yaml", own)).analysis.tolerance, 1e-7);
  double looser = 1.0;
  for (const char* preset : {"draft", "standard", "reference"}) {
    const Case c = read_case(scratch.file("own.yaml"), {std::string("analysis.accuracy=") + preset});
    EXPECT_LT(c.analysis.tolerance, looser) << preset;
    looser = c.analysis.tolerance;
    const Case again = read_case(scratch.write("again.yaml", c.effective_yaml));
    EXPECT_EQ(again.analysis.tolerance, c.analysis.tolerance) << preset;
  }
}

TEST(ReadCase, AccuracyAcceptsAWrenchErrorInsteadOfAPreset) {
  const ScratchFolder scratch;
  const Case c = read_case(
      scratch.write("asked.yaml", std::string(kWall) + "analysis: {accuracy: {wrench_error: 1e-3}}\n"));
  EXPECT_EQ(c.analysis.accuracy.wrench_error, 1e-3);
  EXPECT_EQ(c.analysis.accuracy.preset, RequestedAccuracy::Preset::custom);
  EXPECT_EQ(read_case(scratch.write("again.yaml", c.effective_yaml)).analysis.accuracy.wrench_error, 1e-3);
}

TEST(ReadCase, EffectiveYamlReadsBackAsTheSameCase) {
  const ScratchFolder scratch;
  for (const char* text : {kDome, kWall}) {
    const Case first = read_case(scratch.write("first.yaml", text));
    const Case again = read_case(scratch.write("again.yaml", first.effective_yaml));
    EXPECT_EQ(first.effective_yaml, again.effective_yaml);
    EXPECT_EQ(first.hash, again.hash);
    EXPECT_EQ(first.geometry_hash, again.geometry_hash);
  }
}

TEST(ReadCase, TextRoundTripsThroughTheEffectiveYaml) {
  const ScratchFolder scratch;
  const Case first =
      read_case(scratch.write("a.yaml", std::string(kWall) + "title: \"<b>\\\"x\\\" \\\\ # é\\n: yes\"\n"));
  EXPECT_EQ(first.title, "<b>\"x\" \\ # é\n: yes");
  EXPECT_EQ(read_case(scratch.write("b.yaml", first.effective_yaml)).title, first.title);
}

// A run from run.yaml must be the same run: the default is written there as relative, and nothing else is.
TEST(ReadCase, LeftOutComplianceIsRelative) {
  const ScratchFolder scratch;
  const std::string wall =
      "geometry: {surface: {type: wall, length: 3}, bond: {type: running, rings: 2, blocks_per_ring: 2}}\n";
  const Case c = read_case(scratch.write("wall.yaml", wall));
  EXPECT_EQ(c.joints.compliance.relative, 1e-4);
  EXPECT_EQ(c.joints.compliance.per, Compliance::Per::area);
  EXPECT_NE(c.effective_yaml.find("relative: 0.0001"), std::string::npos) << c.effective_yaml;
  EXPECT_EQ(c.effective_yaml.find("per:"), std::string::npos) << c.effective_yaml;
  EXPECT_EQ(read_case(scratch.write("again.yaml", c.effective_yaml)).hash, c.hash);
}

TEST(ReadCase, DensityIsUnitWeightOverStandardGravity) {
  const ScratchFolder scratch;
  const std::string path = scratch.write("wall.yaml", kWall);
  const Case c = read_case(path, {"material.density=1800"});
  EXPECT_DOUBLE_EQ(c.material.density(), 1800.0);  // one product and one quotient: 2 ulp
  EXPECT_DOUBLE_EQ(c.material.unit_weight, 17658.0);
}

TEST(ReadCase, HashDependsOnValuesAndNotOnSpelling) {
  const ScratchFolder scratch;
  const std::string path = scratch.write("dome.yaml", kDome);
  const Case plain = read_case(path);
  EXPECT_EQ(plain.hash, read_case(path, {"joints.friction=3.0e-1"}).hash);
  const Case other = read_case(path, {"joints.friction=0.31"});
  EXPECT_NE(plain.hash, other.hash);
  EXPECT_EQ(plain.geometry_hash, other.geometry_hash);
  EXPECT_NE(plain.geometry_hash, read_case(path, {"geometry.surface.span=46"}).geometry_hash);
  EXPECT_NE(plain.geometry_hash, read_case(path, {"material.density=1800"}).geometry_hash);
}

// A run must not be resumed, and an assembly not used, after an edit of a file that the case names.
TEST(ReadCase, HashesCoverTheContentsOfFiles) {
  const ScratchFolder scratch;
  const std::string moved = scratch.write(
      "moved.yaml",
      std::string(kWall) +
          "supports: {base_motion: {quantity: acceleration, direction: [1, 0, 0], file: a.csv}}\n"
          "analysis: {type: dynamic, duration: 1}\n");
  scratch.write("a.csv", "0, 0\n1, 1\n");
  const Case before = read_case(moved);
  EXPECT_EQ(read_case(moved).hash, before.hash);
  scratch.write("a.csv", "0, 0\n1, 2\n");
  const Case after = read_case(moved);
  EXPECT_NE(after.hash, before.hash);
  EXPECT_EQ(after.geometry_hash, before.geometry_hash) << "the generator does not read it";

  const std::string imported =
      scratch.write("imported.yaml", "geometry: {import: {file: blocks}}\nmaterial: {density: 2000}\n");
  scratch.write("blocks/a.obj", "o a\n");
  const std::string one_file = read_case(imported).geometry_hash;
  scratch.write("blocks/a.obj", "o b\n");
  const std::string another = read_case(imported).geometry_hash;
  scratch.write("blocks/b.obj", "o c\n");
  EXPECT_EQ((std::set{one_file, another, read_case(imported).geometry_hash}.size()), 3u);
}

TEST(ReadCase, SetOptionsOverrideInOrderAndAcceptYaml) {
  const ScratchFolder scratch;
  const std::string path = scratch.write("dome.yaml", kDome);
  const Case c = read_case(path, {"joints.friction=0.1", "joints.friction=0.2", "loads.gravity=[1, 0, -9]",
                                  "geometry.stage={rings: 26}", "loads.lantern=null"});
  EXPECT_EQ(c.joints.friction, 0.2);
  EXPECT_EQ(c.loads.gravity.x(), 1.0);
  ASSERT_TRUE(c.geometry.stage);
  EXPECT_EQ(c.geometry.stage->rings, 26);
  EXPECT_FALSE(c.loads.lantern);
}

// A value that was forgotten, or a shell variable that is not set, is no wish for the default.
TEST(ReadCase, NullRemovesAnInheritedKeyAndAMissingValueIsAnError) {
  const ScratchFolder scratch;
  const std::string base = scratch.write("dome.yaml", kDome);
  const auto friction_of = [&](const std::string& value) {
    return read_case(scratch.write("own.yaml", "extends: dome.yaml\njoints:\n  friction:" + value + "\n"))
        .joints.friction;
  };
  EXPECT_EQ(friction_of(" 0.2"), 0.2);
  for (const char* null : {" null", " ~", " Null  # none"})
    EXPECT_EQ(friction_of(null), Joints{}.friction) << null;
  EXPECT_EQ(read_case(base, {"joints.friction=0.2", "joints.friction=null"}).joints.friction,
            Joints{}.friction);
  EXPECT_EQ(read_case(base, {"joints.cohesion=null"}).joints.friction, read_case(base).joints.friction);
  for (const char* missing : {"", "  # 0.5", "\ntitle: ~"}) {
    try {
      friction_of(missing);
      FAIL() << missing;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("joints.friction is empty"), std::string::npos)
          << error.what();
    }
  }
  EXPECT_THROW(read_case(base, {"joints.friction="}), InputError);
}

TEST(ReadCase, ADifferentTypeKeepsTheKeysThatItHasAndLeavesOutTheOthers) {
  const ScratchFolder scratch;
  const std::string path = scratch.write("dome.yaml", kDome);
  const Case c = read_case(path, {"geometry.surface.length=5", "geometry.surface.type=wall"});
  EXPECT_EQ(std::get<WallSurface>(c.geometry.surface).length, 5.0);
  EXPECT_EQ(std::get<WallSurface>(c.geometry.surface).thickness, 2.2);
  EXPECT_EQ(c.left_out, std::vector<std::string>{"geometry.surface.span"});
  EXPECT_EQ(c.keys->find("geometry")->find("surface")->find("span"), nullptr);
  // Through a case that extends it, and of an item of a list; the same blocks as with all keys written.
  scratch.write(
      "layers.yaml",
      "geometry:\n  surface: {type: wall}\n"
      "  wythes: [{name: a, thickness: 1, bond: {type: running, rings: 8, slices_per_block: 4}}]\n");
  const Case stack = read_case(scratch.write(
      "stack.yaml", "extends: layers.yaml\ngeometry: {'wythes[0]': {bond: {type: stack, phase: 0.5}}}\n"));
  EXPECT_EQ(std::get<StackBond>(*stack.geometry.wythes[0].bond).rings, 8);
  EXPECT_EQ(std::get<StackBond>(*stack.geometry.wythes[0].bond).slices_per_block, 4);
  const Case filled = read_case(
      scratch.write("filled.yaml", "extends: stack.yaml\ngeometry: {'wythes[0]': {bond: {type: fill}}}\n"));
  EXPECT_EQ(std::get<FillBond>(*filled.geometry.wythes[0].bond).rings, 8);
  EXPECT_EQ(filled.left_out, std::vector<std::string>{"geometry.wythes[0].bond.phase"});
  // Keys beside the new type are read strictly.
  EXPECT_THROW(read_case(path, {"geometry.surface.type=wall", "geometry.surface.span=5"}), InputError);
  const Case dynamic = read_case(path, {"analysis={tolerance: 1e-6, type: dynamic}"});
  EXPECT_EQ(dynamic.analysis.tolerance, 1e-6);
}

TEST(ReadCase, AKeyWithANumberChangesOneItemOfAList) {
  const ScratchFolder scratch;
  const std::string path = scratch.write("wall.yaml",
                                         "joints: {compliance: {per: area}}\n"
                                         "geometry:\n"
                                         "  surface: {type: wall}\n"
                                         "  wythes: [{name: a, thickness: 1, bond: {type: running}}, {name: "
                                         "b, thickness: 2, bond: {type: running}}]\n");
  const Case c = read_case(path, {"geometry.wythes[1].thickness=0.5", "geometry.wythes[1].bond.type=stack"});
  EXPECT_EQ(c.geometry.wythes[0].thickness.at(0.0), 1.0);
  EXPECT_EQ(c.geometry.wythes[1].thickness.at(0.0), 0.5);
  EXPECT_EQ(c.geometry.wythes[1].name, "b");
  EXPECT_TRUE(std::holds_alternative<StackBond>(*c.geometry.wythes[1].bond));
  for (const char* key : {"wythes[2]", "wythes[-1]", "wythes[x]", "wythes[]"}) try {
      read_case(path, {fmt::format("geometry.{}.thickness=1", key)});
      FAIL() << key;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("wythes has 2 items, numbered from 0"), std::string::npos)
          << error.what();
    }
}

TEST(Extends, OverridesTheKeysGivenAndKeepsTheOthers) {
  const ScratchFolder scratch;
  scratch.write("base/dome.yaml", kDome);
  scratch.write("middle.yaml", "extends: base/dome.yaml\njoints: {friction: 0.5}\n");
  const Case c = read_case(scratch.write("top.yaml", "extends: middle.yaml\nanalysis: {type: dynamic}\n"));
  EXPECT_EQ(c.joints.friction, 0.5);
  EXPECT_EQ(c.joints.compliance.tangential, 2e-8);
  EXPECT_EQ(c.analysis.type, AnalysisType::dynamic);
}

// Members are run where the file itself says so: `make` finds sweeps and ensembles by it.
TEST(Extends, LeavesASweepAndSaysSo) {
  const ScratchFolder scratch;
  scratch.write("dome.yaml", std::string(kDome) + "sweep: [{key: joints.friction, values: [0.1, 0.2]}]\n");
  const Case c = read_case(scratch.write("top.yaml", "extends: dome.yaml\njoints: {friction: 0.5}\n"));
  EXPECT_TRUE(c.sweep.empty());
  ASSERT_FALSE(c.warnings.empty());
  EXPECT_EQ(c.warnings.front(),
            "top.yaml extends dome.yaml, but not its sweep: this is one run; to run its members, repeat the "
            "sweep here");
  const Case own = read_case(
      scratch.write("own.yaml", "extends: dome.yaml\nsweep: [{key: joints.friction, values: [0.3]}]\n"));
  ASSERT_EQ(own.sweep.size(), 1u);
  EXPECT_EQ(own.sweep.front().values, std::vector<std::string>{"0.3"});
}

TEST(Extends, ErrorNamesTheFileThatContainsIt) {
  const ScratchFolder scratch;
  scratch.write("dome.yaml", std::string(kDome) + "output: {frames_every: 0}\n");
  const std::string top = scratch.write("top.yaml", "extends: dome.yaml\n");
  try {
    read_case(top);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              scratch.file("dome.yaml") + ":12:24: error: output.frames_every = 0: must be > 0");
  }
}

}  // namespace
}  // namespace cupola::case_reader_test
