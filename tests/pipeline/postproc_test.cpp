// Evaluation of solved models against closed forms and published numbers.

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/files/content_hash.hpp"
#include "generators/generate.hpp"
#include "postproc/evaluation/evaluation.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/fresh_folder.hpp"
#include "tests/verification/references.hpp"

namespace cupola::postproc_test {
namespace {

Evaluation solved(const Case& scene) {
  const Assembly assembly = generate(scene);
  const std::string folder = test::fresh_folder("results");
  ResultsWriter writer(folder, content_hash(assembly));
  AnalysisSinks sinks;
  sinks.frame = [&writer](const Frame& frame) { writer.write_frame(frame); };
  sinks.log = sinks.history = [](const std::string&) {};
  Summary summary = run_analysis(scene, assembly, sinks).value();
  summary.assembly_hash = content_hash(assembly);
  writer.write_summary(summary);
  return evaluate(scene, assembly, ResultsReader(folder, content_hash(assembly)));
}

Case paper_dome(double lantern) {
  Case scene;
  RunningBond bond;
  bond.rings = 40;
  scene.geometry.bond = bond;
  scene.analysis.tolerance = 1e-9;
  if (lantern > 0.0) scene.loads.lantern = TopLoad{lantern};
  scene.postproc.meridians = {{"meridian", 0.0}};
  return scene;
}

// Seven rings in running bond: the ratio covers six beds, three periods. All sails are alike, so it is the
// mean ratio of the thrust lines of one sail. A lantern on one side makes the sails differ: the ratio
// is that of the sums over all sails.
TEST(PostprocVault, RibOverMidSailCoversAllSailsAndWholePeriods) {
  Case scene;
  OctagonalVault vault;
  vault.crown_angle_deg = 30.0;
  scene.geometry.surface = vault;
  RunningBond bond;
  bond.rings = 7;
  scene.geometry.bond = bond;
  scene.postproc.meridians = {{"corner", 0.0}, {"middle", 22.5}};
  const Evaluation e = solved(scene);
  ASSERT_TRUE(e.rib_over_mid_sail);
  EXPECT_EQ(e.rib_over_mid_sail->sails, 8);
  EXPECT_EQ(e.rib_over_mid_sail->beds, 6);
  double mean = 0.0, largest = 0.0;
  for (size_t bed = 0; bed < 6; ++bed) {
    const double ratio = e.meridians[0].thrust.points[bed].r / e.meridians[1].thrust.points[bed].r;
    mean += ratio / 6.0;
    largest = std::max(largest, ratio);
  }
  EXPECT_NEAR(e.rib_over_mid_sail->mean, mean, 1e-6);  // the solver's tolerance
  EXPECT_NEAR(e.rib_over_mid_sail->largest, largest, 1e-6);
  scene.loads.forces = {{.block = 1, .point = {}, .force = {0.0, 0.0, -3e5}, .time = {}}};
  scene.postproc.meridians.clear();
  for (int half = 0; half < 16; ++half)
    scene.postproc.meridians.push_back({fmt::format("at {}", half), 22.5 * half});
  const Evaluation uneven = solved(scene);
  double of_sums = 0.0;
  for (size_t bed = 0; bed < 6; ++bed) {
    double ribs = 0.0, middles = 0.0;
    for (size_t i = 0; i < 16; ++i) (i % 2 == 0 ? ribs : middles) += uneven.meridians[i].thrust.points[bed].r;
    of_sums += ribs / middles / 6.0;
  }
  EXPECT_NEAR(uneven.rib_over_mid_sail->mean, of_sums, 1e-12);  // rounding
  EXPECT_GT(std::abs(uneven.meridians[4].thrust.points[0].r / uneven.meridians[0].thrust.points[0].r - 1.0),
            1e-3);
}

/// A semicircular arch of 27 voussoirs, its thickness 0.15 of its mean radius.
Evaluation ranges_of_arch() {
  Case scene;
  ArchSurface arch;
  arch.span = 18.5;
  arch.thickness = 1.5;
  scene.geometry.surface = arch;
  StackBond bond;
  bond.rings = 27;
  bond.blocks_per_ring = 1;
  scene.geometry.bond = bond;
  scene.joints.friction = 0.6;
  scene.analysis.type = AnalysisType::range;
  scene.analysis.range.quantities = {BaseThrust{}};
  scene.analysis.range.states = true;
  return solved(scene);
}

// J. Heyman, The Stone Skeleton (1995): as its supports spread, an arch opens at the intrados of the crown,
// so that the line of least thrust touches the extrados there and the intrados in the haunches; as they
// close, the line of greatest thrust touches the extrados at the springings and the intrados in the haunches.
// The horizontal force of a line is the value of the range.
TEST(PostprocRange, LinesOfLeastAndGreatestThrustOfAnArch) {
  const Evaluation e = ranges_of_arch();
  ASSERT_EQ(e.summary.status, Status::stable);
  ASSERT_EQ(e.meridians.size(), 1u);
  ASSERT_TRUE(e.meridians[0].least_thrust && e.meridians[0].greatest_thrust);
  const ForceRange& thrust = e.summary.ranges.at(0);
  EXPECT_GT(thrust.chosen.value(), thrust.min.value.value());
  EXPECT_LT(thrust.chosen.value(), thrust.max.value.value());
  constexpr double kTouches = 1e-3;  // of the thickness; the forces are exact to 1e-6 of the thrust
  const auto lowest = [](const ThrustLine& line) {
    double position = 1.0;
    for (const ThrustPoint& p : line.points) position = std::min(position, p.position);
    return position;
  };
  for (const auto& [line, value] : {std::pair{&*e.meridians[0].least_thrust, *thrust.min.value},
                                    std::pair{&*e.meridians[0].greatest_thrust, *thrust.max.value}}) {
    ASSERT_EQ(line->points.size(), 28u);
    EXPECT_NEAR(lowest(*line), 0.0, kTouches);
    for (const ThrustPoint& p : line->points) {
      EXPECT_GE(p.face_distance, -kTouches * 1.5) << "bed " << p.bed;
      EXPECT_NEAR(std::abs(p.force.x()), value, 1e-5 * value);
    }
  }
  EXPECT_NEAR(e.meridians[0].least_thrust->points[13].position, 1.0, kTouches) << "beside the crown";
  EXPECT_NEAR(e.meridians[0].greatest_thrust->points[0].position, 1.0, kTouches) << "at the springing";
}

// Ring forces and membrane forces over the height are rows of the verification manual.
TEST(PostprocDome, RingsCarryTheLoadAbove) {
  const Evaluation e = solved(paper_dome(0.02));
  ASSERT_EQ(e.summary.status, Status::stable);
  ASSERT_EQ(e.rings.size(), 40u);
  for (const RingSum& ring : e.rings) EXPECT_LE(ring.relative_difference, 1e-7) << "ring " << ring.ring;
}

TEST(PostprocDome, HoopForcesAreTensileBelowAndCompressiveAbove) {
  const Evaluation e = solved(paper_dome(0.02));
  // In membrane theory the sign changes at 26.9 deg, ring 18. Friction allows less hoop tension than membrane
  // theory requires, so that the sign changes nearby.
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b) {
    const Block& block = e.assembly.blocks[b];
    if (block.fixed) continue;
    const double hoop = e.last.fields[b].hoop_force;
    if (block.ring >= 2 && block.ring < 14) {
      EXPECT_LT(hoop, 0.0) << "ring " << block.ring;
    } else if (block.ring >= 24) {
      EXPECT_GT(hoop, 0.0) << "ring " << block.ring;
    }
  }
}

// 27 polygonal voussoirs, t/R = 0.15, mu = 0.6: the thrust lies between its bounds, and each springing
// carries half the weight.
TEST(PostprocArch, ThrustLiesBetweenMinimumAndMaximum) {
  const verification::ReferenceRow& bounds = verification::reference("arch_thrust").rows.front();
  ASSERT_EQ(bounds.name(), "voussoirs 27, t/R 0.15");
  Case scene;
  ArchSurface arch;
  arch.span = 1.85;
  arch.thickness = 0.15;
  arch.width = 0.3;
  scene.geometry.surface = arch;
  StackBond bond;
  bond.rings = 27;
  bond.blocks_per_ring = 1;
  bond.slices_per_block = 2;
  scene.geometry.bond = bond;
  scene.joints.friction = 0.6;
  const Evaluation e = solved(scene);
  int springings = 0;
  for (const JointWrench& joint : e.last.joints.wrenches) {
    if (joint.kind != JointKind::base) continue;
    ++springings;
    const int voussoir = e.assembly.blocks[joint.block_a].fixed ? joint.block_b : joint.block_a;
    const Vec3 reaction = wrench_on(joint, voussoir).force;
    const double thrust = std::hypot(reaction.x(), reaction.y()) / e.summary.weight_N;
    EXPECT_GE(thrust, bounds.low);
    EXPECT_LE(thrust, bounds.high);
    EXPECT_NEAR(reaction.z() / e.summary.weight_N, 0.5, 1e-6);
  }
  EXPECT_EQ(springings, 2);
  ASSERT_EQ(e.meridians.size(), 1u);
  const ThrustLine& line = e.meridians[0].thrust;
  ASSERT_EQ(line.points.size(), 28u) << "both springings and 26 joints";
  EXPECT_TRUE(line.inside);
  for (const ThrustPoint& p : line.points)  // mirror symmetry
    EXPECT_NEAR(p.r, line.points[27 - static_cast<size_t>(p.bed)].r, 1e-6 * e.summary.weight_N);
}

// Strips one block wide cover the shell. The vertical forces of all strips across a bed add up to the weight
// above it, including the upright blocks that the bed cuts.
TEST(PostprocHerringbone, StripsTogetherCarryTheWeightAboveTheBed) {
  Case scene;
  DomeSurface dome;
  dome.crown_angle_deg = 30.0;
  scene.geometry.surface = dome;
  HerringboneBond bond;
  bond.rings = 10;
  bond.blocks_per_ring = 16;
  bond.spirals = 4;
  scene.geometry.bond = bond;
  scene.joints.friction = 0.6;
  for (int strip = 0; strip < 16; ++strip)
    scene.postproc.meridians.push_back({"strip" + std::to_string(strip), 3.0 + strip * 22.5});
  const Evaluation e = solved(scene);
  ASSERT_EQ(e.summary.status, Status::stable);
  EXPECT_NEAR(e.shell.block_width_rad.front(), 2.0 * std::numbers::pi / 16, 1e-9);
  const double g = scene.loads.gravity.norm();
  for (int bed = 0; bed < 10; ++bed) {
    double above = 0.0, carried = 0.0;
    for (const Part& part : e.assembly.parts)
      if (part.ring >= bed) above += e.assembly.blocks[part.block].density * part.volume * g;
    for (const MeridianEvaluation& m : e.meridians)
      for (const ThrustPoint& p : m.thrust.points)
        if (p.bed == bed) carried += p.v;
    EXPECT_NEAR(carried / above, 1.0, 1e-7) << "bed " << bed;
  }
}

}  // namespace
}  // namespace cupola::postproc_test
