#include "postproc/mechanics/thrust_line.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "postproc/evaluation/meridians.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::thrust_line_test {
namespace {

/// A vault of revolution in which one force with the given components acts on every block from below, at the
/// given position through the thickness in the middle of its bed.
struct MeridianScene {
  Assembly assembly;
  Shell shell;
  ContactTable contacts;
  JointWrenches joints;
  std::vector<Wrench> from_below;

  MeridianScene(int rings, int blocks, double offset, double position, double outward, double upward)
      : assembly(test::ring_vault(rings, blocks, offset)), shell(shell_of(assembly, Vec3::UnitZ())) {
    from_below.resize(assembly.blocks.size());
    index_by_block(assembly.blocks.size(), &joints);
    for (int k = 0; k < rings; ++k)
      for (const BedFacet& f : shell.beds[k]) {
        const Vec3 inner = 0.5 * (f.intrados_a + f.intrados_b), outer = 0.5 * (f.extrados_a + f.extrados_b);
        const Vec3 radial = Vec3(inner.x(), inner.y(), 0.0).normalized();
        from_below[f.block].point = assembly.blocks[f.block].centroid;
        from_below[f.block].add_force(inner + position * (outer - inner),
                                      outward * radial + upward * Vec3::UnitZ());
      }
  }
  ThrustInput input() const { return {&assembly, &shell, &contacts, &joints, from_below, {0, 0, -9.81}}; }
};

TEST(ThrustLine, PositionAndResultantAreFoundAtEveryAzimuth) {
  const double outward = -300.0, upward = 1000.0;
  for (const double offset : {0.0, 0.123}) {
    const MeridianScene scene(6, 16, offset, 0.3, outward, upward);
    // In the middle of a block, on a head joint, in between, and at the jump of the azimuth from 180 to -180
    // degrees.
    for (const double azimuth : {0.0, 11.25, 5.0, 180.0, -180.0, 359.0}) {
      const ThrustLine line = thrust_line(scene.input(), "m", azimuth);
      ASSERT_EQ(line.points.size(), 6u) << azimuth;
      for (const ThrustPoint& p : line.points) {
        EXPECT_NEAR(p.position, 0.3, 1e-10);
        EXPECT_NEAR(p.r, std::hypot(outward, upward), 1e-8);
        EXPECT_NEAR(p.v, upward, 1e-8);
        EXPECT_NEAR(p.couple_length, 0.0, 1e-10);
        EXPECT_NEAR(p.geometric_safety, 2.5, 1e-9);  // half the thickness over 0.2 of it
        // On the meridian half-plane, not on the opposite one.
        const double a = azimuth * std::numbers::pi / 180.0;
        EXPECT_NEAR(-std::sin(a) * p.point.x() + std::cos(a) * p.point.y(), 0.0, 1e-12);
        EXPECT_GT(std::cos(a) * p.point.x() + std::sin(a) * p.point.y(), 0.0);
      }
      EXPECT_TRUE(line.inside);
    }
  }
}

TEST(ThrustLine, CountsBedsOfBlocksWithoutSkins) {
  MeridianScene scene(6, 16, 0.0, 0.3, -300.0, 1000.0);
  scene.shell.beds[3].clear();
  scene.shell.blocks[3].clear();
  const ThrustLine line = thrust_line(scene.input(), "m", 5.0);
  EXPECT_EQ(line.points.size(), 5u);
  EXPECT_EQ(line.without_skins, 1);
}

/// Eight stones on a support, bent round the corners of an octagon at multiples of 45 degrees, 2 m from the
/// axis to the middle of its sides. Each is two parts; the first goes on along the plane of its intrados.
Assembly octagon_of_bent_stones() {
  const double angle = std::numbers::pi / 8, c = std::cos(angle), s = std::sin(angle);
  const double first[][2] = {{2.1 / c, -0.1 / s}, {2.2 / c, 0.0}, {2.0 * c, 2.0 * s}, {2.2 * c, 2.2 * s}};
  const double second[][2] = {{2.0 * c, -2.0 * s}, {2.2 * c, -2.2 * s}, {2.0 / c, 0.0}, {2.1 / c, -0.1 / s}};
  Assembly a;
  a.num_rings = 1;
  a.sheets = {{"vault", 0, 1, true, Sheet::ThrustLines::by_azimuth}};
  Block support;
  support.kind = BlockKind::support;
  support.fixed = true;
  support.ring = -1;
  a.blocks.push_back(support);
  test::add_box(&a, 0, -1, {-3, -3, -1}, {3, 3, 0}, FaceKind::bed);
  for (int k = 1; k <= 8; ++k) {
    const Eigen::AngleAxisd turn(2.0 * k * angle, Vec3::UnitZ());
    const auto add_corners = [&](const double corners[4][2]) {
      for (int i = 0; i < 8; ++i)
        a.vertices.push_back(turn * Vec3(corners[i % 4][0], corners[i % 4][1], i < 4 ? 0.0 : 1.0));
    };
    Block block;
    block.ring = 0;
    block.slot = k;
    block.density = 1800.0;
    a.blocks.push_back(block);
    using enum FaceKind;
    add_corners(first);
    test::add_hexahedron(&a, k, 0, {bed, top, intrados, extrados, extrados, head});
    add_corners(second);
    test::add_hexahedron(&a, k, 0, {bed, top, intrados, extrados, head, internal});
  }
  compute_mass_properties(&a);
  return a;
}

/// Points under both parts of the stones, at 0.3 of the thickness; 1000 N on each stone.
ContactTable contacts_under_bent_stones() {
  ContactTable c;
  for (int i = 0; i < 32; ++i) {
    const int stone = 1 + i / 4;
    const double to_side = (i % 2 ? 1.0 : -1.0) * std::numbers::pi / 8;
    const double across = (i % 4 < 2 ? 0.1 : 0.5) * (i % 2 ? -1.0 : 1.0);  // m, from the middle of the side
    const Eigen::AngleAxisd turn(stone * std::numbers::pi / 4 + to_side, Vec3::UnitZ());
    c.joint.push_back(stone - 1);
    c.block_a.push_back(0);
    c.block_b.push_back(stone);
    c.kind.push_back(JointKind::base);
    c.ring.push_back(0);
    c.point.push_back(turn * Vec3(2.06, across, 0.0));
    c.normal.push_back(Vec3::UnitZ());
    c.force.emplace_back(0.0, 0.0, 250.0);
    c.normal_force.push_back(250.0);
    c.area.push_back(0.04);
    for (auto* v : {&c.gap, &c.friction_use, &c.slip, &c.law_violation}) v->push_back(0.0);
  }
  return c;
}

// Wherever the meridian runs: through a corner, a head joint, the middle of a part, and where the parts
// overlap (up to 6.6 degrees before the corner). Tolerances: rounding.
TEST(ThrustLine, HasItsPositionOnBentStones) {
  const Assembly a = octagon_of_bent_stones();
  const Shell shell = shell_of(a, Vec3::UnitZ());
  EXPECT_NEAR(shell.block_width_rad.front(), std::numbers::pi / 4, 1e-12);
  const ContactTable contacts = contacts_under_bent_stones();
  const JointWrenches joints = joint_wrenches(a, contacts, shell);
  const ThrustInput input{&a, &shell, &contacts, &joints, wrenches_from_below(a, joints), {0, 0, -9.81}};
  for (const double azimuth : {0.0, 22.5, 10.0, -10.0, -3.0}) {
    const ThrustLine line = thrust_line(input, "m", azimuth);
    ASSERT_FALSE(line.points.empty()) << azimuth;
    const ThrustPoint& p = line.points.front();
    EXPECT_NEAR(p.position, 0.3, 1e-9) << azimuth;
    EXPECT_NEAR(p.v, 1000.0, 1e-6) << azimuth;
    const double side = azimuth < 0.0 ? -std::numbers::pi / 8 : std::numbers::pi / 8;
    const Vec3 normal(std::cos(side), std::sin(side), 0.0);
    EXPECT_NEAR(normal.dot(p.intrados), 2.0, 1e-12) << azimuth;
    EXPECT_NEAR(normal.dot(p.extrados), 2.2, 1e-12) << azimuth;
  }
}

// Two stones of the first bed stop 1e-12 rad beside their joint over the meridian, and the neighbours of the
// stone that fills the strip on the second one reach as far into it.
TEST(ThrustLine, DoesNotDependOnRounding) {
  MeridianScene scene(2, 8, 0.0, 0.3, -300.0, 1000.0);
  for (const auto& [block, angle] : {std::pair(0, 1e-12), {7, -1e-12}, {8, -1e-12}, {14, 1e-12}})
    for (int v = 8 * block; v < 8 * block + 8; ++v)
      scene.assembly.vertices[v] = Eigen::AngleAxisd(angle, Vec3::UnitZ()) * scene.assembly.vertices[v];
  scene.shell = shell_of(scene.assembly, Vec3::UnitZ());
  const ThrustLine line = thrust_line(scene.input(), "m", 0.0);
  ASSERT_EQ(line.points.size(), 2u);
  for (const ThrustPoint& p : line.points) {
    EXPECT_NEAR(p.position, 0.3, 1e-9) << "what a turn by 1e-12 rad may change";
    EXPECT_EQ(p.blocks, p.bed == 0 ? 2 : 1);
  }
}

// The strip is as wide as a standard block, or as the blocks that are there.
TEST(ThrustLine, VaultOfUprightsAloneHasAStrip) {
  MeridianScene scene(3, 12, 0.0, 0.3, -100.0, 1000.0);
  for (Block& block : scene.assembly.blocks) block.kind = BlockKind::herringbone;
  scene.shell = shell_of(scene.assembly, Vec3::UnitZ());
  const ThrustLine line = thrust_line(scene.input(), "m", 0.0);
  ASSERT_EQ(line.points.size(), 3u);
  EXPECT_NEAR(line.points.front().v, 1000.0, 1e-9);
}

TEST(ThrustLine, LineOutsideTheThicknessIsReported) {
  const MeridianScene scene(4, 12, 0.0, 1.1, -100.0, 1000.0);
  const ThrustLine line = thrust_line(scene.input(), "m", 0.0);
  EXPECT_FALSE(line.inside);
  // The meridian crosses the even rings at a head joint, where the thickness is the full 1 m.
  EXPECT_NEAR(line.least_face_distance, -0.1, 1e-9);
}

// A hinge lies on the face, but for the closing of its joint and the last step of a motion.
TEST(ThrustLine, LineOnAFaceIsInside) {
  const auto line_at = [](double position) {
    const MeridianScene scene(4, 12, 0.0, position, -100.0, 1000.0);
    return thrust_line(scene.input(), "m", 0.0);
  };
  EXPECT_TRUE(line_at(1.0 + 1e-5).inside);
  EXPECT_TRUE(line_at(-1e-5).inside);
  EXPECT_FALSE(line_at(1.001).inside);
}

TEST(ThrustLine, ResultantAlongTheBedHasNoPosition) {
  MeridianScene scene(4, 12, 0.0, 0.5, -100.0, 1000.0);
  for (Wrench& w : scene.from_below)  // ring 2: along the bed, with a small normal component
    if (scene.assembly.blocks[static_cast<size_t>(&w - scene.from_below.data())].ring == 2) {
      const Vec3 radial = Vec3(w.point.x(), w.point.y(), 0.0).normalized();
      w.force = 500.0 * radial + 20.0 * Vec3::UnitZ();
    }
  const ThrustLine line = thrust_line(scene.input(), "m", 0.0);
  ASSERT_EQ(line.points.size(), 4u);
  EXPECT_EQ(line.undefined, 1);
  EXPECT_FALSE(line.points[2].is_placed());
  EXPECT_TRUE(std::isnan(line.points[2].face_distance));
  EXPECT_NEAR(line.points[2].v, 20.0, 1e-9) << "the force itself is defined";
  EXPECT_TRUE(line.inside) << "at all beds where the position is defined";
  // The meridian crosses the odd rings in the middle of a facet, where the horizontal part of the thickness
  // of 1 m is shorter by cos 15 deg. The bed of ring 1 is inclined by 0.02 rad.
  EXPECT_NEAR(line.least_face_distance,
              0.5 * std::hypot(std::cos(0.02) * std::cos(std::numbers::pi / 12), std::sin(0.02)), 1e-9);
}

TEST(ThrustLine, RoundingErrorsHaveNoPosition) {
  MeridianScene scene(4, 12, 0.0, 0.5, -100.0, 1000.0);
  scene.joints.floor = floor_of(1000.0, 0.0, 1.0);  // 1e-3 N
  for (size_t b = 0; b < scene.from_below.size(); ++b)
    if (scene.assembly.blocks[b].ring == 3) scene.from_below[b] = 1e-7 * scene.from_below[b];
  EXPECT_EQ(thrust_line(scene.input(), "m", 0.0).undefined, 1);
  for (size_t b = 0; b < scene.from_below.size(); ++b)
    if (scene.assembly.blocks[b].ring == 3) scene.from_below[b] = 100.0 * scene.from_below[b];
  EXPECT_EQ(thrust_line(scene.input(), "m", 0.0).undefined, 0);
}

// One block carries 1000 N at 0.25 of the thickness. Its neighbour is pushed along the bed by 400 N and
// carries 1 N: its line of action meets the bed some 40 m away, but its weight of 1/1000 moves the resultant
// of the strip by about 0.04 m only.
TEST(ThrustLine, PushAlongTheBedHardlyMovesTheResultant) {
  MeridianScene scene(1, 12, 0.0, 0.25, 0.0, 1000.0);
  Wrench& pushed = scene.from_below[0];
  pushed.force = Vec3::UnitZ() + 400.0 * Vec3(pushed.point.x(), pushed.point.y(), 0.0).normalized();
  pushed.moment = Vec3::Zero();
  const ThrustLine line = thrust_line(scene.input(), "m", 0.0);  // blocks 0 and 11, half of each
  ASSERT_EQ(line.points.size(), 1u);
  ASSERT_EQ(line.points[0].blocks, 2);
  EXPECT_NEAR(line.points[0].position, 0.25 - 0.04, 0.02);
}

/// A support under one block three rings high, of 1.2 x 0.8 x 1.5 m.
Assembly tall_block() {
  Assembly a = test::column(3);
  for (Part& part : a.parts) part.block = std::min(part.block, 1);
  a.blocks.resize(2);
  a.blocks[1].num_rings = 3;
  for (int f = 0; f < a.num_faces(); ++f) {  // the faces between the rings lie at z = 0.5 and 1 m
    const std::vector<Vec3> points = face_points(a, f);
    const double z = polygon_centroid(points).z();
    const bool horizontal = std::abs(polygon_plane(points).normal.z()) > 0.9;
    if (horizontal && z > 0.4 && z < 1.1) a.face_kinds[f] = FaceKind::internal;
  }
  compute_mass_properties(&a);
  return a;
}

/// The thrust line of the tall block under its weight and loads of 1000 N down in all.
ThrustLine line_of_tall_block(const std::vector<PointForce>& loads) {
  const Assembly a = tall_block();
  const Frame frame = test::column_at_rest(a, 9.81, loads.empty() ? 0.0 : 1000.0, 0.6, 0.4);
  const Shell shell = shell_of(a, Vec3::UnitZ());
  EXPECT_TRUE(shell.beds[1].front().internal);
  const JointWrenches joints = joint_wrenches(a, frame.contacts, shell);
  ThrustInput input{&a, &shell, &frame.contacts, &joints, wrenches_from_below(a, joints), {0, 0, -9.81}};
  input.loads = loads;
  return thrust_line(input, "m", std::nullopt);
}

// A bed inside a block carries the weight of the piece above and the loads on it, those at the bed included.
TEST(ThrustLine, BedInsideABlockCarriesThePieceAbove) {
  const double ring_weight = 0.48 * 1800.0 * 9.81;
  const Vec3 down(0, 0, -1000);
  const auto at = [](double z) { return Vec3(0.6, 0.4, z); };
  struct Loaded {
    std::vector<PointForce> loads;
    double v[3];  // N, of the loads, at each bed
  };
  for (const Loaded& loaded :
       {Loaded{{}, {0, 0, 0}}, Loaded{{{1, at(1.5), down}}, {1000, 1000, 1000}},
        Loaded{{{1, at(0.75), down}}, {1000, 1000, 0}}, Loaded{{{1, at(0.5), down}}, {1000, 1000, 0}},
        Loaded{{{0, at(1.5), 7.0 * down}, {1, at(1.2), 0.4 * down}, {1, at(0.7), 0.6 * down}},
               {1000, 1000, 400}}}) {
    const ThrustLine line = line_of_tall_block(loaded.loads);
    ASSERT_EQ(line.points.size(), 3u);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(line.points[k].v, (3 - k) * ring_weight + loaded.v[k], 1e-9 * ring_weight) << k;
      EXPECT_NEAR(line.points[k].position, 0.5, 1e-12) << k;
    }
  }
}

// The forces of a couple that stands for a moment at the centroid, 0.75 m high, lie on both sides of the bed
// at 0.5 m. Together they are no force.
TEST(ThrustLine, MomentInsideABlockIsNotDivided) {
  const Vec3 along(0, 1e4, 0);
  const ThrustLine line = line_of_tall_block({{1, {0.6, 0.4, 1.5}, {0, 0, -1000}},
                                              {1, {0.6, 0.4, 1.2}, along, PointForce::kDeadLoad, true},
                                              {1, {0.6, 0.4, 0.3}, -along, PointForce::kDeadLoad, true}});
  ASSERT_EQ(line.points.size(), 3u);
  EXPECT_NEAR(line.points[1].force.y(), 0.0, 1e-9);
  EXPECT_NEAR(line.points[2].force.y(), 0.0, 1e-9) << "the moment acts below";
}

// Beds of 1.2 x 0.8 m, whose four corners stand for 0.24 m2 each. A force in the middle presses on the whole
// bed, one on a face on half of it, at the face. Across a wide arch the blocks of a course may hold each
// other: forces along the bed, at right angles to the arch, with a torsion about its normal. They shift the
// line of action of the wrench, but not the point where the bed presses.
TEST(ThrustLine, OfAnArchIsAtTheContactPoints) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, 9.81, 0.0, 0.6, 0.4);
  for (int i = 0; i < frame.contacts.size(); ++i) {
    const Vec3 arm = frame.contacts.point[i] - Vec3(0.6, 0.4, frame.contacts.point[i].z());
    frame.contacts.force[i] +=
        frame.contacts.normal_force[i] * (0.3 * Vec3::UnitX() + Vec3::UnitZ().cross(arm));
  }
  const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                       test::fresh_folder("results"));
  const ThrustLine line = thrust_line(thrust_input(e, e.last), "arch", std::nullopt);
  ASSERT_EQ(line.points.size(), 3u);
  for (const ThrustPoint& p : line.points) EXPECT_NEAR(p.position, 0.5, 1e-12) << p.bed;
}

// A rib of one block under a web of two, each a stack of its own: the line of either ends with the bed that
// closes it, here on the web with the weight of that, there free.
TEST(ThrustLine, OfEveryStackHasTheBedThatClosesIt) {
  Assembly a = test::column(3);
  using enum Sheet::ThrustLines;
  a.sheets = {{.name = "rib", .num_rings = 1, .thrust_lines = one},
              {.name = "web", .first_ring = 1, .num_rings = 2, .thrust_lines = one}};
  const Frame frame = test::column_at_rest(a, 9.81, 0.0, 0.6, 0.3);
  const Shell shell = shell_of(a, Vec3::UnitZ());
  const JointWrenches joints = joint_wrenches(a, frame.contacts, shell);
  const ThrustInput input{&a,           &shell, &frame.contacts, &joints, wrenches_from_below(a, joints),
                          {0, 0, -9.81}};
  const ThrustLine rib = thrust_line(input, "rib", std::nullopt, std::nullopt, 0);
  ASSERT_EQ(rib.points.size(), 2u);
  EXPECT_EQ(rib.points[1].bed, 1);
  EXPECT_NEAR(rib.points[1].v, 2.0 * 0.48 * 1800.0 * 9.81, 1e-6) << "rounding of sums";
  EXPECT_NEAR((rib.points[1].point - Vec3(0.6, 0.3, 0.5)).norm(), 0.0, 1e-12) << "rounding";
  EXPECT_EQ(thrust_line(input, "web", std::nullopt, std::nullopt, 1).points.size(), 2u);
}

// On a path, forces act where the blocks stood when their contacts were found, not where the step moved them:
// the line is that of the column as built, moved there.
TEST(ThrustLine, StandsWhereTheContactsWereFound) {
  const Evaluation e = test::column_evaluation(0.6, 0.3);
  const Eigen::Isometry3d move = Eigen::Translation3d(0.3, -0.7, 0.2) * Eigen::AngleAxisd(0.4, Vec3::UnitX());
  const Eigen::Quaterniond turn(move.linear());
  Frame frame = e.last.frame;
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b) {
    frame.blocks.position[b] += Vec3(0.0, 0.05, 0.0);
    frame.blocks.displacement[b] += Vec3(0.0, 0.05, 0.0);
    frame.blocks.contact_position.push_back(move * e.assembly.blocks[b].centroid);
    frame.blocks.contact_quaternion_wxyz.emplace_back(turn.w(), turn.x(), turn.y(), turn.z());
  }
  const auto line_of = [&e](const Frame& of) {
    const FrameEvaluation evaluated = evaluate_frame(e, of);
    return thrust_line(thrust_input(e, evaluated), "arch", std::nullopt);
  };
  const ThrustLine built = line_of(e.last.frame);
  frame.role = FrameRole::path;
  for (Vec3& point : frame.contacts.point) point = move * point;
  for (Vec3& force : frame.contacts.force) force = move.linear() * force;
  for (Vec3& normal : frame.contacts.normal) normal = move.linear() * normal;
  const ThrustLine moved = line_of(frame);
  ASSERT_EQ(built.points.size(), 3u);
  ASSERT_EQ(moved.points.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    const ThrustPoint &a = built.points[k], &b = moved.points[k];
    EXPECT_NEAR(a.position, 0.375, 1e-12);
    EXPECT_NEAR(b.position, 0.375, 1e-12);
    EXPECT_NEAR(b.face_distance, 0.3, 1e-12);
    EXPECT_NEAR(b.compressed_from, a.compressed_from, 1e-12);
    for (const auto& [from, to] : {std::pair(a.point, b.point), {a.intrados, b.intrados}})
      EXPECT_NEAR((move * from - to).norm(), 0.0, 1e-12);
  }
  // The wrench on a block is about its centroid there.
  const Wrench of_built = evaluate_frame(e, e.last.frame).from_below[2];
  const Wrench of_moved = evaluate_frame(e, frame).from_below[2];
  EXPECT_NEAR((move * of_built.point - of_moved.point).norm(), 0.0, 1e-12);
  EXPECT_NEAR((move.linear() * of_built.moment - of_moved.moment).norm(), 0.0, 1e-9 * of_built.moment.norm());
}

// A strip of several blocks keeps its resultant where the ground has moved and the axis with it.
TEST(ThrustLine, MovesWithAVaultOnMovedGround) {
  MeridianScene scene(4, 12, 0.1, 0.3, -300.0, 1000.0);
  const ThrustLine built = thrust_line(scene.input(), "m", 20.0);
  const Eigen::Isometry3d move = Eigen::Isometry3d(Eigen::Translation3d(2.0, 3.0, 0.5));
  for (Wrench& w : scene.from_below) w.point = move * w.point;
  ThrustInput input = scene.input();
  input.poses.of_block.assign(scene.assembly.blocks.size(), move);
  const ThrustLine moved = thrust_line(input, "m", 20.0);
  ASSERT_EQ(moved.points.size(), 4u);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(moved.points[k].position, 0.3, 1e-12);
    EXPECT_NEAR((move * built.points[k].point - moved.points[k].point).norm(), 0.0, 1e-12);
    EXPECT_NEAR(moved.points[k].r, built.points[k].r, 1e-9);
    EXPECT_NEAR(moved.points[k].couple_length, 0.0, 1e-9);
  }
}

TEST(ThrustLine, TheCompressedZoneIsWherePointsPush) {
  const Assembly a = test::column(3);
  const Shell shell = shell_of(a, Vec3::UnitZ());
  const double weight = 0.48 * 1800.0 * 9.81;  // of a block
  for (const double y : {0.4, 0.8}) {
    const Frame frame = test::column_at_rest(a, 9.81, 0.0, 0.6, y);
    const JointWrenches joints = joint_wrenches(a, frame.contacts, shell);
    const ThrustInput input{&a,           &shell, &frame.contacts, &joints, wrenches_from_below(a, joints),
                            {0, 0, -9.81}};
    const ThrustLine line = thrust_line(input, "m", std::nullopt);
    ASSERT_EQ(line.points.size(), 3u);
    for (const ThrustPoint& p : line.points) {
      const bool whole = y == 0.4;
      EXPECT_NEAR(p.compressed_to - p.compressed_from, whole ? 1.0 : 0.0, 1e-12);
      EXPECT_NEAR(0.5 * (p.compressed_to + p.compressed_from), p.position, 1e-12);
      const double normal = (3 - p.bed) * weight;
      EXPECT_NEAR(p.pressure, normal / (whole ? 0.96 : 0.48), 1e-9 * normal);
    }
  }
}

}  // namespace
}  // namespace cupola::thrust_line_test
