// Ranges of forces over all admissible states, against closed forms. Independently computed ranges of arches
// and domes are rows of the verification manual.
#include <cmath>

#include <gtest/gtest.h>

#include "solver/analysis/admissible/rigid_scene.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::range_test {
namespace {

constexpr double kRange = 1e-6;  // the gap that a range analysis promises, relative

Case range_case(double friction, std::vector<ForceQuantity> quantities) {
  Case scene = testing::make_case(friction, 1e-8, 0.01);
  scene.geometry.surface = WallSurface{};
  scene.analysis.type = AnalysisType::range;
  scene.analysis.tolerance = 1e-9;
  scene.analysis.range.quantities = std::move(quantities);
  return scene;
}

Summary ranges_of(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks = {}) {
  return run_range(scene, assembly, sinks).value();
}

/// The only range, which must have been found.
ForceRange range_of(const Case& scene, const Assembly& assembly) {
  const Summary summary = ranges_of(scene, assembly);
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  EXPECT_LE(summary.accuracy.reached, summary.accuracy.asked);
  return summary.ranges.empty() ? ForceRange{} : summary.ranges.front();
}

JointForce joint(int a, int b, JointForce::Component component, Vec3 direction = Vec3::UnitX()) {
  return {a, b, component, direction};
}

void expect_ends(const ForceRange& range, double low, double high, double size) {
  ASSERT_TRUE(range.min.value && range.max.value) << range.quantity;
  EXPECT_NEAR(*range.min.value, low, kRange * size) << range.quantity;
  EXPECT_NEAR(*range.max.value, high, kRange * size) << range.quantity;
  EXPECT_LE(*range.min.bound, *range.min.value + kRange * size);
  EXPECT_GE(*range.max.bound, *range.max.value - kRange * size);
  if (range.chosen) {
    EXPECT_GE(*range.chosen, low - kRange * size) << range.quantity;
    EXPECT_LE(*range.chosen, high + kRange * size) << range.quantity;
  }
}

/// A slab on four square legs, which are supports: legs 0 to 3 counter-clockwise, slab 4.
Assembly table(double half_distance, double leg) {
  std::vector<testing::BoxSpec> boxes;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    boxes.push_back(
        {.center = {x * half_distance, y * half_distance, -0.5}, .size = {leg, leg, 1.0}, .fixed = true});
  boxes.push_back({.center = {0, 0, 0.1}, .size = {4, 4, 0.2}});
  return testing::make_boxes(boxes);
}

double weight_of(const Assembly& assembly) {
  return free_weight(assembly, testing::kG);
}

// A leg carries the most when the slab rests on the inner corner of this leg and the outer corner of the
// opposite one.
TEST(Range, LegOfATable) {
  const Assembly slab = table(1.5, 0.2);
  const double inner = 1.4, outer = 1.6, weight = weight_of(slab);
  for (const auto per : {Compliance::Per::point, Compliance::Per::area}) {
    Case scene = range_case(0.5, {BlockReaction{0, BlockReaction::Component::vertical, {}}});
    scene.joints.compliance.per = per;
    const ForceRange leg = range_of(scene, slab);
    expect_ends(leg, 0.0, weight * outer / (inner + outer), weight);
    EXPECT_NEAR(leg.chosen.value(), weight / 4, 1e-6 * weight);
  }
}

// Ends of ranges hold for the geometry as built: a leg that has sunk leaves them, and the table stands on the
// others. Robustness is as it was, too.
TEST(Range, DoesNotDependOnMotionsOfSupports) {
  const Assembly slab = table(1.5, 0.2);
  const double inner = 1.4, outer = 1.6, weight = weight_of(slab);
  Case scene = range_case(0.5, {BlockReaction{0, BlockReaction::Component::vertical, {}}});
  scene.supports.moves = {{.region = {.blocks = {BlockRef{0}}}, .displacement = {0.3, 0, -0.1}, .time = {}}};
  expect_ends(range_of(scene, slab), 0.0, weight * outer / (inner + outer), weight);
  scene.analysis.type = AnalysisType::static_;
  scene.analysis.robustness = 4;
  const Summary summary = run_static(scene, slab, {});
  ASSERT_TRUE(summary.robustness) << summary.message;
  EXPECT_NEAR(summary.robustness->acceleration_g, 0.5, 1e-4) << "a flat slab slides";
}

// In the state that loads one leg most the legs beside it carry nothing, which proves their least forces
// without a solve: four solves instead of eight. With `states` each end has its own.
TEST(Range, LeastForcesAreProvenByTheStatesOfOtherEnds) {
  const Assembly slab = table(1.5, 0.2);
  const double inner = 1.4, outer = 1.6, weight = weight_of(slab);
  Case scene = range_case(0.5, {AllJoints{}});
  for (const int solves : {1, 2}) {  // the other legs follow by symmetry
    scene.analysis.range.states = solves == 2;
    const Summary summary = ranges_of(scene, slab);
    EXPECT_EQ(summary.status, Status::stable) << summary.message;
    EXPECT_EQ(summary.steps, solves);
    ASSERT_EQ(summary.ranges.size(), 4u);
    for (const ForceRange& leg : summary.ranges)
      expect_ends(leg, 0.0, weight * outer / (inner + outer), weight);
  }
}

// Far from the z axis, of which no sector of 90 degrees holds one leg alone, sectors are those about the axis
// of the sheet. One too narrow to hold a joint is refused.
TEST(Range, SectorsOfJointsLieAboutTheAxisOfTheSheet) {
  Assembly slab = table(1.5, 0.2);
  const Vec3 aside(-20.0, -13.0, 0.0);
  for (Vec3& vertex : slab.vertices) vertex += aside;
  compute_mass_properties(&slab);
  slab.sheets = {{.name = "table", .num_rings = 1, .origin = aside}};
  const Summary summary = ranges_of(range_case(0.5, {AllJoints{.sectors = 4}}), slab);
  ASSERT_EQ(summary.ranges.size(), 1u);
  EXPECT_EQ(summary.ranges[0].quantity, "normal force of joint 2-4");
  EXPECT_THROW(ranges_of(range_case(0.5, {AllJoints{.sectors = 100}}), slab), InputError);
}

// The corners of a dry face carry what all its points do. Strength belongs to areas, and needs all points.
TEST(Range, DryFacesHaveTheirCornersOnly) {
  const Assembly slab = table(1.5, 0.2);
  Case scene = range_case(0.5, {});
  scene.joints.compliance.per = Compliance::Per::area;
  const auto contacts = [&](bool all_points) {
    return rigid_scene(scene, std::shared_ptr<const Assembly>(&slab, [](const Assembly*) {}), 1.0, all_points)
        .contacts;
  };
  const auto area = [](const ContactSet& set) {
    double sum = 0.0;
    for (const Contact& contact : set.points) sum += contact.area;
    return sum;
  };
  const ContactSet corners = contacts(false), all = contacts(true);
  EXPECT_EQ(corners.points.size(), 16u) << "four legs of four corners";
  EXPECT_EQ(all.points.size(), 20u) << "and four centres";
  EXPECT_NEAR(area(corners), 4 * 0.2 * 0.2, 1e-12) << "rounding";
  EXPECT_NEAR(area(all), 4 * 0.2 * 0.2, 1e-12);
  for (const Contact& corner : corners.points) EXPECT_NEAR(corner.area, 0.01, 1e-13);
  scene.joints.strength.compression = 1e6;
  EXPECT_EQ(contacts(false).points.size(), 20u);
}

// Equilibrium alone determines these; friction and redundant contacts make no difference.
TEST(Range, ClosesWhereEquilibriumDetermines) {
  const Assembly box = testing::box_on_floor({1.0, 0.5, 0.2});
  const double weight = weight_of(box);
  for (const double friction : {0.0, 0.4, 10.0}) {
    expect_ends(range_of(range_case(friction, {joint(0, 1, JointForce::Component::normal)}), box), weight,
                weight, weight);
    expect_ends(range_of(range_case(friction, {joint(0, 1, JointForce::Component::shear)}), box), 0.0, 0.0,
                weight);
  }
  Case pushed = range_case(
      0.4, {joint(0, 1, JointForce::Component::eccentricity), joint(0, 1, JointForce::Component::resultant)});
  BlockForce push;
  push.block.number = 1;
  push.force = {0.2 * weight, 0, 0};
  pushed.loads.forces = {push};
  const Summary summary = ranges_of(pushed, box);
  ASSERT_EQ(summary.ranges.size(), 2u);
  expect_ends(summary.ranges[0], 0.2 * 0.1, 0.2 * 0.1, 0.1);  // force times height over weight, m
  expect_ends(summary.ranges[1], -0.2 * weight, -0.2 * weight, weight);
}

// A block held by friction between two walls: each presses with at least W / (2 mu), and with any larger
// force.
TEST(Range, JammedBlockHasNoLargestForce) {
  const Assembly jammed = testing::make_boxes(
      {{.center = {-1, 0, 0}, .fixed = true}, {.center = {0, 0, 0}}, {.center = {1, 0, 0}, .fixed = true}});
  const double weight = weight_of(jammed);
  std::vector<Frame> frames;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  Case scene = range_case(0.5, {joint(0, 1, JointForce::Component::normal)});
  scene.analysis.range.states = true;
  const Summary summary = ranges_of(scene, jammed, sinks);
  EXPECT_EQ(summary.status, Status::stable) << summary.message;
  ASSERT_EQ(summary.ranges.size(), 1u);
  const ForceRange& range = summary.ranges.front();
  EXPECT_NEAR(range.min.value.value(), weight, kRange * weight);
  EXPECT_EQ(range.max.outcome, RangeOutcome::unbounded);
  EXPECT_FALSE(range.max.value);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(range.max.frame, 1);
  EXPECT_EQ(range.min.frame, 2);
  EXPECT_EQ(frames[2].time, 2.0);
}

// With a compressive strength the same joint presses with at most its strength.
TEST(Range, CompressiveStrengthEndsEveryRange) {
  const Assembly jammed = testing::make_boxes(
      {{.center = {-1, 0, 0}, .fixed = true}, {.center = {0, 0, 0}}, {.center = {1, 0, 0}, .fixed = true}});
  const double weight = weight_of(jammed);
  Case scene = range_case(0.5, {joint(0, 1, JointForce::Component::normal)});
  scene.joints.compliance.per = Compliance::Per::area;
  scene.joints.strength.compression = 7.0 * weight;  // Pa, on 1 m2
  expect_ends(range_of(scene, jammed), weight, 7.0 * weight, weight);
}

// Two equal blocks on the floor and a third one across both: its weight may rest on either.
TEST(Range, ShareAndRatioOfTheBase) {
  const Assembly pier = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {10, 10, 1}, .fixed = true},
                                             {.center = {-1, 0, 0.5}},
                                             {.center = {1, 0, 0.5}},
                                             {.center = {0, 0, 1.5}, .size = {3, 1, 1}}});
  const double weight = 1000.0 * testing::kG, beam = 3.0 * weight;
  // The beam rests on the inner edge of one block, 0.5 m from its middle, and on the outer edge of the other.
  const double most = beam * 1.5 / (0.5 + 1.5) + weight, least = beam * 0.5 / (0.5 + 1.5) + weight;
  const BaseBlocks first{BaseBlocks::Group::listed, {1}}, second{BaseBlocks::Group::listed, {2}};
  const Summary summary = ranges_of(range_case(0.5, {BaseShare{first}, BaseRatio{first, second}}), pier);
  ASSERT_EQ(summary.ranges.size(), 2u) << summary.message;
  expect_ends(summary.ranges[0], least / (least + most), most / (least + most), 1.0);
  expect_ends(summary.ranges[1], least / most, most / least, 1.0);
  EXPECT_EQ(summary.ranges[0].quantity, "share of block 1") << "a name of its own for each list";
  EXPECT_EQ(summary.ranges[1].quantity, "ratio of block 1 to block 2");
}

// At both ends of a ratio, whose forces are found up to a factor, the strength of the feet is used but not
// exceeded.
TEST(Range, RatioOfFeetWithStrength) {
  const Assembly pier = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {10, 10, 1}, .fixed = true},
                                             {.center = {-1, 0, 0.5}},
                                             {.center = {1, 0, 0.5}},
                                             {.center = {0, 0, 1.5}, .size = {3, 1, 1}}});
  const double strength = 3.0 * 1000.0 * testing::kG;  // Pa; 5 m3 rest on 2 m2
  Case scene =
      range_case(1.0, {BaseRatio{{BaseBlocks::Group::listed, {1}}, {BaseBlocks::Group::listed, {2}}}});
  scene.joints.compliance.per = Compliance::Per::area;
  scene.joints.strength.compression = strength;
  scene.analysis.range.states = true;
  std::vector<Frame> frames;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const Summary summary = ranges_of(scene, pier, sinks);
  ASSERT_EQ(summary.status, Status::stable) << summary.message;
  const ForceRange& ratio = summary.ranges.at(0);
  EXPECT_NEAR(*ratio.min.value * *ratio.max.value, 1.0, kRange) << "symmetry";
  ASSERT_EQ(frames.size(), 3u);
  for (const RangeEnd& end : {ratio.min, ratio.max}) {
    const auto& contacts = frames[end.frame.value()].contacts;
    double feet[2] = {0.0, 0.0}, largest = 0.0;
    for (size_t i = 0; i < contacts.area.size(); ++i) {
      largest = std::max(largest, contacts.normal_force[i] / contacts.area[i]);
      if (contacts.block_a[i] == 0) feet[contacts.block_b[i] - 1] += contacts.normal_force[i];
    }
    EXPECT_NEAR(largest, strength, 1e-6 * strength);
    EXPECT_NEAR(feet[0] / feet[1], *end.value, kRange);
  }
}

// Outwards of a wall is across the barrel on it, as in reactions.csv; the wall has no hoop force for that.
TEST(Range, OutwardOfAWallIsThatOfItsBarrel) {
  Assembly box = testing::box_on_floor({1.0, 1.0, 1.0});
  const Sheet wall{.name = "wall", .num_rings = 1};
  const Sheet barrel{
      .name = "barrel", .first_ring = 1, .num_rings = 1, .thrust_lines = Sheet::ThrustLines::one};
  box.num_rings = 2;
  box.sheets = {wall, barrel};
  box.blocks[1].ring = 0;
  Case scene = range_case(0.5, {BlockReaction{0, BlockReaction::Component::outward, {}}});
  const double push = 0.1 * weight_of(box);
  scene.loads.forces = {BlockForce{.block = 1, .point = {}, .force = Vec3(push, 0.0, 0.0), .time = {}}};
  expect_ends(range_of(scene, box), push, push, weight_of(box));  // equilibrium alone
  scene.analysis.range.quantities = {HoopForce{0}};
  EXPECT_THROW(ranges_of(scene, box), InputError);
}

TEST(Range, WithoutAdmissibleState) {
  Case scene = range_case(0.2, {joint(0, 1, JointForce::Component::normal)});
  scene.loads.gravity = testing::tilted_gravity(0.5);
  std::vector<Frame> frames;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  const Summary summary = ranges_of(scene, testing::box_on_floor({1, 1, 1}), sinks);
  EXPECT_EQ(summary.status, Status::moving);
  EXPECT_TRUE(summary.ranges.empty());
  EXPECT_DOUBLE_EQ(summary.applied_load_N.norm(), summary.weight_N) << "the weight alone";
  EXPECT_NE(summary.message.find("no admissible state exists"), std::string::npos) << summary.message;
  ASSERT_EQ(frames.size(), 1u);
}

// Ranges of one joint in two directions are told apart by their names alone.
TEST(Range, NamesTheDirectionOfAJoint) {
  using enum JointForce::Component;
  const std::vector<ForceRange> ranges =
      ranges_of(
          range_case(0.4, {joint(0, 1, resultant, Vec3::UnitX()), joint(0, 1, resultant, Vec3(0.0, 0.5, 1.0)),
                           joint(0, 1, shear, Vec3::UnitY())}),
          testing::box_on_floor({1, 1, 1}))
          .ranges;
  ASSERT_EQ(ranges.size(), 3u);
  EXPECT_EQ(ranges[0].quantity, "resultant of joint 0-1 along (1, 0, 0)");
  EXPECT_EQ(ranges[1].quantity, "resultant of joint 0-1 along (0, 0.5, 1)");
  EXPECT_EQ(ranges[2].quantity, "shear of joint 0-1 along (0, 1, 0)");
}

// A component of a force does not depend on the length of the vector that names its direction.
TEST(Range, DirectionsAreOfAnyLength) {
  using enum JointForce::Component;
  const Assembly box = testing::box_on_floor({1, 1, 1});
  const double weight = weight_of(box);
  const std::vector<ForceRange> ranges =
      ranges_of(
          range_case(0.4, {joint(0, 1, resultant, Vec3(0, 0, 5)), BlockReaction{0, {}, Vec3(0, 0, -0.2)}}),
          box)
          .ranges;
  ASSERT_EQ(ranges.size(), 2u);
  for (const ForceRange& range : ranges) expect_ends(range, weight, weight, weight);  // equilibrium alone
}

TEST(Range, RefusesWhatTheModelDoesNotHave) {
  const Assembly pair = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {10, 10, 1}, .fixed = true},
                                             {.center = {0, 0, 0.5}},
                                             {.center = {3, 0, 0.5}}});
  const auto message = [&](const ForceQuantity& quantity) -> std::string {
    try {
      ranges_of(range_case(0.4, {quantity}), pair);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(BaseThrust{}).find("no axis"), std::string::npos);
  EXPECT_NE(message(joint(1, 2, JointForce::Component::normal))
                .find("blocks 1 and 2 have no closed joint; block 1 touches 0"),
            std::string::npos);
  EXPECT_NE(message(joint(0, 1, JointForce::Component::shear, Vec3::UnitZ())).find("normal to joint 0-1"),
            std::string::npos);
  EXPECT_NE(message(BlockReaction{7, BlockReaction::Component::vertical, {}}).find("block 7 does not exist"),
            std::string::npos);
  EXPECT_NE(message(TieForce{}).find("the model has no ties"), std::string::npos);
  EXPECT_NE(message(BaseShare{{BaseBlocks::Group::ribs, {}}}).find("no block of the group"),
            std::string::npos);
}

// A cube of weight W hangs on three ties in a row, symmetric about its middle, each of which yields at Y =
// 0.4 W: the ties at the ends carry T each and the one in the middle S = W - 2 T, so that T lies in [(W - Y)
// / 2, Y] and S in [W - 2 Y, Y].
TEST(Range, OfTiesThatYield) {
  const Assembly cube = testing::make_boxes(
      {{.center = {0, 0, 3}, .size = {4, 4, 1}, .fixed = true}, {.center = {0, 0, 1}, .size = {1, 1, 1}}});
  const double W = cube.blocks[1].mass * testing::kG, Y = 0.4 * W;
  Case scene = range_case(0.4, {TieForce{0}, TieForce{1}});
  for (const double y : {-0.4, 0.0, 0.4}) {
    PairTie tie;
    tie.block_a = 0;
    tie.block_b = 1;
    tie.point_a = Vec3(0, y, 2.5);
    tie.point_b = Vec3(0, y, 1.5);
    tie.stiffness = 1e8;
    tie.yield_force = Y;
    scene.ties.pairs.push_back(tie);
  }
  const Summary summary = ranges_of(scene, cube);
  ASSERT_EQ(summary.ranges.size(), 2u) << summary.message;
  expect_ends(summary.ranges[0], 0.5 * (W - Y), Y, W);
  expect_ends(summary.ranges[1], W - 2.0 * Y, Y, W);
}

// A rod holds a box that friction could hold alone. Its tie and its strut, which have a number each, press
// against each other without limit; what the rod carries has one.
TEST(Range, OfARodIsThatOfItsTieLessItsStrut) {
  Assembly box = testing::box_on_floor({1.0, 1.0, 0.2});
  const double weight = box.blocks[1].mass * testing::kG;
  BuiltTie rod;
  rod.block_a = 0;
  rod.block_b = 1;
  rod.point_b = box.blocks[1].centroid;
  rod.point_a = rod.point_b - Vec3::UnitX();
  rod.length = 1.0;
  rod.stiffness = 1e9;
  rod.pushes = true;
  box.ties = {rod};
  const Summary summary = ranges_of(range_case(0.3, {TieForce{0}, TieForce{1}}), box);
  ASSERT_EQ(summary.ranges.size(), 2u) << summary.message;
  for (const ForceRange& range : summary.ranges) {
    EXPECT_EQ(range.quantity, "force of rod 0-1");
    expect_ends(range, -0.3 * weight, 0.3 * weight, weight);
  }
}

// An inclined tie with a slope of 3/4 pulls a box aside: S in it presses the box down by 0.6 S on the floor,
// which rubs against 0.8 S, and the anchor bears S alone. 0.8 S <= 0.3 (W + 0.6 S): S <= 0.3 W / 0.62.
TEST(Range, OfASupportCountsTheTiesAnchoredInIt) {
  const Assembly box =
      testing::make_boxes({{.center = {0, 0, -0.5}, .size = {9, 9, 1}, .fixed = true},
                           {.center = {0, 0, 0.1}, .size = {1, 1, 0.2}},
                           {.center = {4.1, 0, -2.9}, .size = {0.2, 0.2, 0.2}, .fixed = true}});
  const double weight = box.blocks[1].mass * testing::kG, most = 0.3 * weight / 0.62;
  PairTie tie;
  tie.block_a = 1;
  tie.block_b = 2;
  tie.point_a = Vec3(0, 0, 0.1);
  tie.point_b = Vec3(4, 0, -2.9);
  tie.stiffness = 1e8;
  Case scene = range_case(0.3, {BlockReaction{2, BlockReaction::Component::vertical, {}},
                                BlockReaction{2, BlockReaction::Component::vertical, Vec3::UnitX()},
                                BlockReaction{1, BlockReaction::Component::vertical, {}}});
  scene.ties.pairs.push_back(tie);
  const Summary summary = ranges_of(scene, box);
  ASSERT_EQ(summary.ranges.size(), 3u) << summary.message;
  expect_ends(summary.ranges[0], -0.6 * most, 0.0, weight);
  expect_ends(summary.ranges[1], -0.8 * most, 0.0, weight);
  expect_ends(summary.ranges[2], weight, weight, weight);
}

}  // namespace
}  // namespace cupola::range_test
