// Answers about arches and barrels that follow from statics and geometry alone.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/files/summary_file.hpp"
#include "postproc/evaluation/thrust.hpp"
#include "postproc/mechanics/cracks.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/tables/post_summary.hpp"
#include "tests/pipeline/static_run.hpp"
#include "tests/verification/thrust.hpp"

namespace cupola::vault_answers_test {
namespace {

constexpr double kGravity = 9.81, kDensity = 2000.0;
using Vec2 = Eigen::Vector2d;

/// A semicircular arch of n plane voussoirs, in the plane x-z.
struct Arch {
  int n;  // counted from x < 0; the generator counts its blocks from x > 0
  double inner, outer;

  Vec2 at(int joint, bool extrados) const {
    const double angle = std::numbers::pi * (1.0 - static_cast<double>(joint) / n);
    return (extrados ? outer : inner) * Vec2(std::cos(angle), std::sin(angle));
  }
  /// Area and centroid of a voussoir, by the shoelace formula.
  double area(int block, Vec2* centroid = nullptr) const {
    const std::array<Vec2, 4> p{at(block, false), at(block, true), at(block + 1, true), at(block + 1, false)};
    double twice = 0.0;
    Vec2 moment = Vec2::Zero();
    for (size_t i = 0; i < 4; ++i) {
      const Vec2 &a = p[i], &b = p[(i + 1) % 4];
      const double cross = a.x() * b.y() - a.y() * b.x();
      twice += cross;
      moment += cross * (a + b) / 3.0;
    }
    if (centroid) *centroid = moment / twice;
    return 0.5 * std::abs(twice);
  }
};

std::string arch_case(const Arch& arch, double width, int blocks_per_ring, const std::string& rest) {
  return fmt::format(
      "geometry:\n  surface: {{type: arch, span: {}, radius_ratio: 0.5, thickness: {}, width: {}}}\n"
      "  bond: {{type: stack, rings: {}, blocks_per_ring: {}}}\nmaterial: {{density: {}}}\n"
      "loads: {{gravity: [0, 0, {}]{}",
      2.0 * arch.inner, arch.outer - arch.inner, width, arch.n, blocks_per_ring, kDensity, -kGravity, rest);
}

Case read(const ProgramFolder& folder, const std::string& text) {
  std::ofstream(folder.file("case.yaml")) << text;
  return read_case(folder.file("case.yaml"));
}

/// A rigid body turns about a point: the velocity at x for an angular velocity of 1, counterclockwise.
Vec2 turned(const Vec2& arm) {
  return {-arm.y(), arm.x()};
}

// The right springing sinks by d. The two blocks turn together about the inner edge A of the left springing
// and the outer edge B of the right one, by d / AB, because both edges lie at the same height; the crown
// stays closed. Each springing opens at its other edge, a thickness away: t d / (inner + outer radius). The
// angle of 3e-4 is the relative error of first-order geometry, and stiff joints add 1e-4.
TEST(VaultAnswers, ASettledTwoBlockArchOpensAtItsSpringings) {
  const Arch arch{2, 3.0, 3.8};
  const double sinks = 2e-3;
  const ProgramFolder folder;
  const Case scene = read(folder, arch_case(arch, 1.0, 1,
                                            fmt::format(R"(}}
joints: {{friction: 0.8, compliance: {{per: area, normal: 1e-13, tangential: 1e-13}}}}
supports: {{moves: [{{blocks: [3], displacement: [0, 0, {}]}}]}}
)",
                                                        -sinks)));
  const Evaluation e = solve_and_evaluate(scene, folder);
  const std::vector<Crack> cracks = cracks_of(e.last.frame.contacts, e.last.joints);
  ASSERT_EQ(cracks.size(), 2u);
  const double expected = (arch.outer - arch.inner) * sinks / (arch.inner + arch.outer);
  for (const Crack& crack : cracks) {
    const JointWrench& joint = e.last.joints.wrenches[crack.joint];
    EXPECT_TRUE(e.assembly.blocks[joint.block_a].fixed || e.assembly.blocks[joint.block_b].fixed);
    EXPECT_NEAR(crack.widest_gap, expected, 1e-3 * expected);
  }
}

/// The load factor of one mechanism of four hinges, `edges`: bit set, hinge at the extrados. None where
/// joints would overlap, or where the load does no work.
std::optional<double> factor_of(const Arch& arch, const std::array<int, 4>& joints, unsigned edges,
                                const Vec2& load_at, double load) {
  std::array<Vec2, 4> hinge;
  for (unsigned i = 0; i < 4; ++i) hinge[i] = arch.at(joints[i], (edges >> i) & 1u);
  // Velocities: w0 (h1 - h0) + w1 (h2 - h1) + w2 (h3 - h2) = 0, each turned by a right angle, with w0 = +-1.
  Eigen::Matrix2d a;
  a << turned(hinge[2] - hinge[1]), turned(hinge[3] - hinge[2]);
  if (std::abs(a.determinant()) < 1e-9) return std::nullopt;
  for (const double first : {1.0, -1.0}) {
    const Vec2 others = a.inverse() * (-first * turned(hinge[1] - hinge[0]));
    const std::array<double, 5> w{0.0, first, others[0], others[1], 0.0};
    // A joint turns counterclockwise about its outer edge, clockwise about its inner one.
    bool opens = true;
    for (unsigned i = 0; i < 4; ++i)
      opens = opens && (w[i + 1] - w[i]) * ((edges >> i) & 1u ? 1.0 : -1.0) > 1e-9;
    if (!opens) continue;
    const auto sinking = [&](int body, const Vec2& x) {
      Vec2 v = Vec2::Zero();
      for (int i = 1; i <= body; ++i) v += w[i] * turned((i == body ? x : hinge[i]) - hinge[i - 1]);
      return -v.y();
    };
    double dead = 0.0, live = 0.0;
    for (int body = 1; body <= 3; ++body)
      for (int block = joints[body - 1]; block < joints[body]; ++block) {
        Vec2 centroid;
        const double weight = kDensity * kGravity * arch.area(block, &centroid);
        dead += weight * sinking(body, centroid);
        const double low = arch.at(block, true).x(), high = arch.at(block + 1, true).x();
        if (low < load_at.x() && load_at.x() < high) live += load * sinking(body, load_at);
      }
    if (live > 1e-9) return -dead / live;
  }
  return std::nullopt;
}

// The kinematic theorem: of all mechanisms the one with the least factor decides. Friction is high enough to
// exclude sliding.
TEST(VaultAnswers, TheLoadFactorAtTheQuarterIsThatOfFourHinges) {
  const Arch arch{10, 3.0, 3.8};
  const double load = 1000.0;
  const Vec2 at = 3.4 * Vec2(-0.5, std::sqrt(0.75));  // between joints at 126 and 108 degrees
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= arch.n; ++i)
    for (int j = i + 1; j <= arch.n; ++j)
      for (int k = j + 1; k <= arch.n; ++k)
        for (int l = k + 1; l <= arch.n; ++l)
          for (unsigned edges = 0; edges < 16; ++edges)
            if (const auto factor = factor_of(arch, {i, j, k, l}, edges, at, load))
              least = std::min(least, *factor);
  ASSERT_LT(least, 1e6);

  const ProgramFolder folder;
  std::ofstream(folder.file("case.yaml")) << arch_case(
      arch, 1.0, 1,
      fmt::format(R"(, forces: [{{block: 7, point: [{:.17g}, 0.5, {:.17g}], force: [0, 0, {}]}}]}}
joints: {{friction: 3, compliance: {{per: area}}}}
analysis: {{type: limit, limit: {{parameter: load, low: 0, high: 10000}}}}
)",
                  at.x(), at.y(), -load));
  ASSERT_EQ(folder.run("cupola-generate case.yaml --output a.vtu").code, 0);
  ASSERT_EQ(folder.run("cupola-solve case.yaml --assembly a.vtu --output results").code, 0);
  const Summary summary = summary_from_json(slurp(folder.file("results/summary.json")), "summary.json");
  ASSERT_TRUE(summary.critical);
  EXPECT_NEAR(summary.critical->value, least, 1e-5 * least);  // ten times the width of the bracket
  // The answer of the report is the same factor.
  ASSERT_EQ(
      folder.run("cupola-post analyse case.yaml --assembly a.vtu --results results --output post --tables")
          .code,
      0);
  EXPECT_NE(slurp(folder.file("post/answers.json"))
                .find(fmt::format("\"Critical load\",\n    \"value\": \"{:.5g}", summary.critical->stable)),
            std::string::npos)
      << slurp(folder.file("post/answers.json"));
}

// Each springing of a barrel carries half its weight: per metre half of density, gravity and the area of the
// section.
TEST(VaultAnswers, ABarrelRestsOnItsSpringingsByHalfItsWeightPerMetre) {
  const Arch arch{12, 3.0, 3.6};
  const double length = 5.0;
  const ProgramFolder folder;
  const Case scene =
      read(folder, arch_case(arch, length, 4, "}\njoints: {friction: 0.7, compliance: {per: area}}\n"));
  const Evaluation e = solve_and_evaluate(scene, folder);
  double area = 0.0;
  for (int block = 0; block < arch.n; ++block) area += arch.area(block);
  ASSERT_EQ(e.reactions.size(), 2u);
  for (const Reaction& reaction : e.reactions) {
    EXPECT_NEAR(reaction.length, length, 1e-9 * length)
        << "the thickness along the bed, not across the voussoir";
    EXPECT_NEAR(-reaction.force.z() / length, 0.5 * kDensity * kGravity * area,
                1e-6 * kDensity * kGravity * area);
    EXPECT_NEAR(reaction.outward, e.reactions[0].outward, 1e-6 * std::abs(reaction.force.z()));
  }
}

// One thrust in all tables: the forces of the joints on the supports along the horizontal direction outwards
// at the centroid of the joint (docs/results.md). rings.csv, reactions.csv, post/summary.json, the ranges of
// the solver and the verification manual compute it apart; the tolerance is their rounding. Taken at the
// contact points, or at the hull of a joint, the thrust of the octagon differs by 2e-4.
TEST(VaultAnswers, TheThrustHasOneDefinition) {
  for (const std::string surface :
       {"{type: dome, span: 8, radius_ratio: 0.6, thickness: 0.6, crown_angle_deg: 60}",
        "{type: octagonal_vault, construction: circular, span: 8, radius_ratio: 0.8, thickness: 0.6, "
        "crown_angle_deg: 60}",
        "{type: arch, span: 8, radius_ratio: 0.6, thickness: 0.6, width: 2}"}) {
    const ProgramFolder folder;
    const bool arch = surface.starts_with("{type: arch");
    const Case scene =
        read(folder,
             fmt::format("geometry:\n  surface: {}\n  bond: {{type: running, rings: 8, blocks_per_ring: {}, "
                         "slices_per_block: 2}}\njoints: {{friction: 0.7, compliance: {{per: area}}}}\n"
                         "analysis: {{type: static, range: {{quantities: [thrust]}}}}\n",
                         surface, arch ? 3 : 16));
    const Evaluation e = solve_and_evaluate(scene, folder);
    const double thrust = e.rings.front().radial_thrust, rounding = 1e-9 * e.summary.weight_N;
    EXPECT_GT(thrust, 0.01 * e.summary.weight_N);
    EXPECT_NEAR(post_summary(e).thrust_over_weight.value() * e.summary.weight_N, thrust, rounding);
    double reactions = 0.0;
    for (const Reaction& reaction : e.reactions)
      if (!arch || e.assembly.blocks[reaction.block].centroid.x() > 0.0) reactions += reaction.outward;
    EXPECT_NEAR(reactions, thrust, rounding);
    if (!arch) {
      EXPECT_NEAR(verification::outward_thrust(e.assembly, e.last.frame.contacts), thrust, rounding);
    }
    Case range = scene;
    range.analysis.type = AnalysisType::range;
    const Summary ranges = run_range(range, e.assembly, {}).value();
    // The chosen state is that of the statics, to the tolerance of its residual.
    EXPECT_NEAR(ranges.ranges.at(0).chosen.value(), thrust, 1e-7 * e.summary.weight_N) << surface;
  }
}

// Each springer of a groin vault has two joints with its pier, of which one is no bed. The thrust is that of
// both, in the statics and in the range, whose chosen state is that of the statics.
TEST(VaultAnswers, TheThrustOnPiersCountsEveryJointOfTheSpringers) {
  const ProgramFolder folder;
  Case scene = read_case(bundled_folder() + "/groin_buttresses.yaml");
  scene.analysis.type = AnalysisType::static_;
  scene.analysis.range.quantities = {BaseThrust{}};
  const Evaluation e = solve_and_evaluate(scene, folder);
  const int first = e.assembly.sheets.back().first_ring;
  double sum = 0.0;
  for (const JointWrench& joint : e.last.joints.wrenches) {
    const Block &a = e.assembly.blocks[joint.block_a], &b = e.assembly.blocks[joint.block_b];
    if (std::min(a.ring, b.ring) >= first || std::max(a.ring, b.ring) != first) continue;
    const int springer = a.ring == first ? joint.block_a : joint.block_b;
    sum -= e.assembly.outward(first, joint.centroid).dot(wrench_on(joint, springer).force);
  }
  EXPECT_GT(sum, 0.1 * e.summary.weight_N);
  EXPECT_NEAR(e.rings.at(first).radial_thrust, sum, 1e-9 * e.summary.weight_N);
  // The thrust of a model is that of its last member, not of its first: here the buttresses.
  EXPECT_NEAR(post_summary(e).thrust_over_weight.value() * e.summary.weight_N, sum,
              1e-9 * e.summary.weight_N);
  Case range = scene;
  range.analysis.type = AnalysisType::range;
  const ForceRange thrust = run_range(range, e.assembly, {}).value().ranges.at(0);
  // A range takes "outwards" at the common centroid of both joints of a springer, the statics at that of
  // each.
  EXPECT_NEAR(thrust.chosen.value(), sum, 1e-5 * sum);
  EXPECT_LE(thrust.min.value.value(), sum);
  EXPECT_GE(thrust.max.value.value(), sum);
}

// Horizontal forces of 2 kN in the direction of x, one on each of two blocks: the springing at x > 0 bears
// 4 kN more than the other, whichever way the arch is turned. Its ratio to the weight is that of the larger.
TEST(VaultAnswers, TheThrustOfAnArchUnderHorizontalLoadHasTwoValues) {
  const char* kJoints = "}\njoints: {friction: 0.8, compliance: {per: area}}\n";
  double largest = 0.0;
  const auto thrust_of = [&](const std::string& rest) {
    const ProgramFolder folder;
    const Evaluation e =
        solve_and_evaluate(read(folder, arch_case({11, 2.0, 2.8}, 1.0, 1, rest + kJoints)), folder);
    EXPECT_TRUE(at_rest(e)) << e.summary.message;
    const std::vector<Thrust> thrusts = thrusts_of(e, e.assembly.sheets.front());
    largest = outward_thrust(e).value();
    return std::pair(thrusts.at(0).force - thrusts.at(1).force, thrust_answer(e).value());
  };
  const auto [none, even] = thrust_of("");
  EXPECT_NEAR(none, 0.0, 1.0);
  EXPECT_NE(even.detail().find("on each side"), std::string::npos) << even.detail();
  const auto [difference, pushed] =
      thrust_of(", forces: [{block: 4, force: [2000, 0, 0]}, {block: 8, force: [2000, 0, 0]}]");
  EXPECT_NEAR(difference, 4000.0, 1.0);  // N; the solver's tolerance is 1e-8 of a block's weight
  EXPECT_EQ(pushed.detail().find("on each side"), std::string::npos) << pushed.detail();
  EXPECT_NE(pushed.value.find(" and "), std::string::npos) << pushed.value;
  EXPECT_NE(pushed.detail().find("towards +x and -x"), std::string::npos) << pushed.detail();
  const double towards_x = largest;
  const auto [same, left] =
      thrust_of(", forces: [{block: 4, force: [-2000, 0, 0]}, {block: 8, force: [-2000, 0, 0]}]");
  EXPECT_NEAR(same, 4000.0, 1.0);
  EXPECT_NE(left.detail().find("towards -x and +x"), std::string::npos) << left.detail();
  EXPECT_NEAR(largest, towards_x, 1.0);
}

// A door takes 1 m of 6 m from one of two supports that bear the same.
TEST(VaultAnswers, EqualThrustsOnDifferentLengthsDifferPerMetre) {
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(read_case(bundled_folder() + "/barrel_windows.yaml"), folder);
  const std::string detail = thrust_answer(e).value().detail();
  EXPECT_TRUE(detail.starts_with("at most ")) << detail;
  EXPECT_NE(detail.find(" over 5 m of support"), std::string::npos) << detail;
}

// Where a barrel stands on supports and on other members, its range counts both, as the statics do.
TEST(VaultAnswers, TheRangeOfAThrustCountsSupportsAndOtherMembers) {
  const ProgramFolder folder;
  Case scene = read_case(bundled_folder() + "/barrel_lunettes.yaml");
  scene.analysis.range.quantities = {BaseThrust{}};
  const Evaluation e = solve_and_evaluate(scene, folder);
  const double thrust = e.rings.at(e.assembly.sheets.back().first_ring).radial_thrust;
  scene.analysis.type = AnalysisType::range;
  const ForceRange range = run_range(scene, e.assembly, {}).value().ranges.at(0);
  // The sides differ by the bonds of the lunettes: their reactions by 1e-4. Without the lunettes 8 % are
  // missing.
  EXPECT_NEAR(range.chosen.value(), thrust, 1e-3 * thrust);
  const std::vector<Thrust> thrusts = thrusts_of(e, e.assembly.sheets.back());
  ASSERT_EQ(thrusts.size(), 2u);
  for (const Thrust& side : thrusts) EXPECT_NEAR(side.force, thrust, 1e-3 * thrust);
}

/// A barrel of half a circle with a radius of 2 m on walls 1 m high that are part of it, under a fill.
std::string barrel_on_walls(double horizontal) {
  return fmt::format(
      "geometry:\n  surface: {{type: vault, plan: {{type: line, length: 3}}, profile: {{type: chain, r: [2, "
      "2, 0], z: [0, 1, 3], radius: [0, 2]}}}}\n  wythes:\n    - {{name: masonry, thickness: {{heights: [1, "
      "1.01], "
      "values: [1.2, 0.5]}}, bond: {{type: stack, rings: 16, blocks_per_ring: 2}}}}\njoints: {{friction: "
      "0.7, "
      "compliance: {{per: area}}}}\nloads: {{faces: [{{fill: {{level: 4, unit_weight: 16000, horizontal: "
      "{}}}}}]}}\n",
      horizontal);
}

// The horizontal pressure of a fill is that on the height of the extrados between the shoulder of the wall
// and the crown, half on each side: k gamma L ((H - low)^2 - (H - high)^2) / 2. The walls, which are free,
// have none.
TEST(VaultAnswers, FillPressesOnTheVaultAndNotOnItsFreeWalls) {
  const ProgramFolder folder;
  const Case scene = read(folder, barrel_on_walls(0.5));
  const Assembly assembly = generate(scene);
  double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0.0;
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (assembly.face_kinds[f] != FaceKind::extrados ||
          polygon_plane(face_points(assembly, f)).normal.z() < 1e-9)
        continue;
      for (const Vec3& corner : face_points(assembly, f)) {
        low = std::min(low, corner.z());
        high = std::max(high, corner.z());
      }
    }
  EXPECT_NEAR(low, 2.0 * (1.0 + std::numbers::pi) / 16, 1e-9)
      << "the lower bed of the course at the shoulder";
  for (const PointForce& force : applied_loads(scene.loads, assembly)) {
    if (force.point.x() > 0.0) sum -= force.force.x();
    EXPECT_GT(force.point.z(), low) << "on no wall";
  }
  const double exact = 0.5 * 16000.0 * 3.0 * 0.5 * (std::pow(4.0 - low, 2) - std::pow(4.0 - high, 2));
  EXPECT_NEAR(sum, exact, 1e-9 * exact);
}

// Up to 0.53 m the fill covers 1 cm above the shoulder of the wall.
TEST(VaultAnswers, FillThatLiesOnNextToNothingIsAWarning) {
  const ProgramFolder folder;
  Case scene = read(folder, barrel_on_walls(0.0));
  EXPECT_EQ(generate(scene).case_warnings, std::vector<std::string>());
  scene.loads.faces[0].fill->level = 0.53;
  const std::vector<std::string> warnings = generate(scene).case_warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("loads.faces[0].fill: up to z = 0.53 m it weighs "), 0u) << warnings[0];
}

bool warns_of_fill(const Evaluation& e) {
  return std::ranges::any_of(e.warnings, [](const std::string& warning) {
    return warning.find("the horizontal pressure of the fill holds it") != std::string::npos;
  });
}

// Nothing acts between the base and the springing, so that the thrust is the same at both. The second course
// reaches over the springing: its lower bed is a sixteenth of 2 (1 + pi) m above the base. Fill that presses
// as much sideways as downwards turns the thrust inwards.
TEST(VaultAnswers, TheThrustHasItsLevelAndItsSign) {
  const ProgramFolder folder;
  const Evaluation e = solve_and_evaluate(read(folder, barrel_on_walls(0.3)), folder);
  ASSERT_TRUE(at_rest(e)) << e.summary.message;
  EXPECT_FALSE(warns_of_fill(e));
  const KeyNumber thrust = thrust_answer(e).value();
  EXPECT_NE(thrust.detail().find("at the base, z = 0 m; at the springing, z = 0.5177 m: " + thrust.value),
            std::string::npos)
      << thrust.detail();
  EXPECT_EQ(thrust.detail().find("negative"), std::string::npos);
  const ProgramFolder pressed_folder;
  const Evaluation pressed = solve_and_evaluate(read(pressed_folder, barrel_on_walls(1.0)), pressed_folder);
  ASSERT_TRUE(at_rest(pressed)) << pressed.summary.message;
  EXPECT_TRUE(thrust_answer(pressed)->detail().starts_with("negative: inwards; "));
  EXPECT_TRUE(warns_of_fill(pressed));
}

}  // namespace
}  // namespace cupola::vault_answers_test
