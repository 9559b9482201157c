#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "solver/collision/contact_detector.hpp"
#include "tests/solver/scenes.hpp"

namespace cupola::edge_test {
namespace {

using namespace testing;  // the scenes
using Eigen::AngleAxisd;
using Eigen::Quaterniond;

constexpr double kPi = std::numbers::pi;

double lowest_corner(const Assembly& scene, const Pose& pose) {
  double z = 1e300;
  for (std::size_t v = 8; v < 16; ++v)  // of the box; the first eight belong to the floor
    z = std::min(z, (pose.p_WB + pose.q_WB * (scene.vertices[v] - scene.blocks[1].centroid)).z());
  return z;
}

/// Poses with the box turned by q and its lowest corner `gap` (m) above the floor.
std::vector<Pose> turned_box(const Assembly& scene, const Quaterniond& q, double gap) {
  auto poses = initial_poses(scene);
  poses[1].q_WB = q;
  poses[1].p_WB.z() += gap - lowest_corner(scene, poses[1]);
  return poses;
}

// A cube turned about an edge on a floor: strength counts the part of the faces within the margin of 1 cm,
// and no more than the points that are left stand for. The last angle is beyond that of faces in contact.
TEST(EdgeContact, OpenFacesBearOnlyWithinTheMargin) {
  const Assembly scene = box_on_floor(Vec3(1, 1, 1));
  for (const double angle : {0.0, 0.009, 0.02, 0.05, 0.15, 0.3, 0.36}) {
    DetectionOptions options;
    options.sampling = {PatchPoints::quadrature, 8};
    const ContactSet set = ContactDetector(scene, options)
                               .update(turned_box(scene, Quaterniond(AngleAxisd(angle, Vec3::UnitY())), 0.0));
    double bearing = 0.0;
    for (const Contact& contact : set.points) bearing += bearing_area(contact, set.patches[contact.patch]);
    // On the plane midway between both faces, which a gap of 2 x tan(angle / 2) at x parts.
    const double half = 0.5 * angle, width = angle > 0.0 ? 0.01 / (2.0 * std::tan(half)) : 1.0;
    const double expected = angle < 0.35 ? std::min(std::cos(half), width) : 0.0;
    EXPECT_LE(bearing, expected + 1e-12) << angle;  // rounding
    EXPECT_GE(bearing, 0.6 * expected) << angle;    // the points at the edge alone stand for a 48th
  }
}

TEST(EdgeContact, EdgeOnAFloorGivesTwoPoints) {
  const Assembly scene = box_on_floor(Vec3(1, 2, 1));
  for (const double angle : {0.36, kPi / 6, kPi / 4, 1.2}) {
    for (const double gap : {-1e-3, 0.0, 1e-3}) {
      const auto poses = turned_box(scene, Quaterniond(AngleAxisd(angle, Vec3::UnitY())), gap);
      const ContactSet set = ContactDetector(scene, {}).update(poses);
      ASSERT_EQ(set.points.size(), 2u) << angle << " " << gap;
      for (const Contact& contact : set.points) {
        EXPECT_NEAR(contact.gap, gap, 1e-13);
        EXPECT_LT((contact.normal - Vec3::UnitZ()).norm(), 1e-13);
        EXPECT_NEAR(std::abs(contact.point_b.y()), 1.0, 1e-13);
        EXPECT_NEAR(contact.point_b.z(), gap, 1e-13);
      }
    }
  }
}

TEST(EdgeContact, VertexOnAFloorGivesOnePoint) {
  const Assembly scene = box_on_floor(Vec3(1, 1, 1));
  const Quaterniond on_corner = Quaterniond::FromTwoVectors(Vec3(1, 1, 1), Vec3(0.02, -0.03, -1));
  for (const double gap : {-2e-3, 0.0, 2e-3}) {
    const ContactSet set = ContactDetector(scene, {}).update(turned_box(scene, on_corner, gap));
    ASSERT_EQ(set.points.size(), 1u);
    EXPECT_NEAR(set.points[0].gap, gap, 1e-13);
    EXPECT_LT((set.points[0].normal - Vec3::UnitZ()).norm(), 1e-13);
  }
}

// Two roof ridges crossing at right angles: one point, with the normal perpendicular to both.
TEST(EdgeContact, CrossingEdgesGiveOnePoint) {
  const double half_diagonal = std::sqrt(0.5);
  for (const double gap : {-3e-3, 0.0, 3e-3}) {
    const Assembly scene =
        make_boxes({{.fixed = true, .rotation = Quaterniond(AngleAxisd(kPi / 4, Vec3::UnitX()))},
                    {.center = {0.1, 0.05, 2 * half_diagonal + gap},
                     .rotation = Quaterniond(AngleAxisd(kPi / 4, Vec3::UnitY()))}});
    const ContactSet set = ContactDetector(scene, {}).update(initial_poses(scene));
    ASSERT_EQ(set.points.size(), 1u) << gap;
    EXPECT_NEAR(set.points[0].gap, gap, 1e-13);
    EXPECT_LT((set.points[0].normal - Vec3::UnitZ()).norm(), 1e-13);
    // The lower ridge runs along x at y = 0, the upper one along y at x = 0.1.
    EXPECT_LT((set.points[0].point_a - Vec3(0.1, 0, half_diagonal)).norm(), 1e-13);
  }
}

// Diagonal neighbours touch along an edge or at a corner, where they transfer no force.
TEST(EdgeContact, DiagonalNeighboursMakeNoContact) {
  const auto pair = [](const Vec3& center) { return make_boxes({{.fixed = true}, {.center = center}}); };
  for (const double offset : {-1e-9, 0.0, 1e-9}) {
    const ContactSet edge =
        ContactDetector(pair({1, 0, 1 + offset}), {}).update(initial_poses(pair({1, 0, 1 + offset})));
    EXPECT_TRUE(edge.points.empty()) << offset;
    const ContactSet corner =
        ContactDetector(pair({1, 1, 1 + offset}), {}).update(initial_poses(pair({1, 1, 1 + offset})));
    EXPECT_TRUE(corner.points.empty()) << offset;
  }
}

// As a box tilts beyond max_angle, its face contact becomes an edge contact. Smallest gap and hinge must not
// jump.
TEST(EdgeContact, IsContinuousWithTheFaceContact) {
  const Assembly scene = box_on_floor(Vec3(1, 1, 1));
  ContactDetector detector(scene, {});
  for (int step = 0; step <= 157; ++step) {
    const double angle = 0.01 * step;
    const ContactSet& set =
        detector.update(turned_box(scene, Quaterniond(AngleAxisd(angle, Vec3::UnitX())), 0.0));
    int touching = 0;
    for (const Contact& contact : set.points) {
      EXPECT_GT(contact.gap, -1e-12) << angle;
      EXPECT_LT((contact.normal - Vec3::UnitZ()).norm(), 1e-12) << angle;
      touching += std::abs(contact.gap) < 1e-12;
    }
    EXPECT_EQ(touching, step == 0 ? 4 : 2) << angle;
  }
}

/// Nearest points of two separate unit cubes.
struct Nearest {
  double distance = 1e300;  ///< m
  /// Number of faces of its cube on which each of the two points lies: 1 inside a face, 2 on an edge, 3 at a
  /// vertex.
  int faces_a = 0, faces_b = 0;
};

/// From sampled points on the faces of each cube projected onto the other: slow, but independent of the
/// separating axes.
Nearest sampled_distance(const Pose& a, const Pose& b, int n) {
  Nearest best;
  const auto num_faces = [](const Vec3& on_cube) {
    return static_cast<int>((on_cube.cwiseAbs().array() > 0.5 - 1e-12).count());
  };
  const auto include = [&](const Pose& from, const Pose& to, const Vec3& x) {
    const Vec3 local = to.q_WB.conjugate() * (from.p_WB + from.q_WB * x - to.p_WB);
    const Vec3 nearest = local.cwiseMax(-0.5).cwiseMin(0.5);
    if ((local - nearest).norm() >= best.distance) return;
    best = {(local - nearest).norm(), num_faces(x), num_faces(nearest)};
    if (&from == &b) std::swap(best.faces_a, best.faces_b);
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.5, 0.5})
      for (int i = 0; i <= n; ++i)
        for (int k = 0; k <= n; ++k) {
          Vec3 x;
          x[axis] = side;
          x[(axis + 1) % 3] = -0.5 + static_cast<double>(i) / n;
          x[(axis + 2) % 3] = -0.5 + static_cast<double>(k) / n;
          include(a, b, x);
          include(b, a, x);
        }
  return best;
}

// Random cubes near each other have a contact if and only if they are within the margin. A vertex that is
// nearest to a vertex or an edge makes one only as it gets closer: no force acts between them before a face
// or two edges meet. The gap of a face contact is at most the distance.
TEST(EdgeContact, RandomBoxesAgreeWithSampledDistance) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> distance(1.2, 1.6);
  const Assembly scene = make_boxes({{.fixed = true}, {}});
  DetectionOptions options;
  options.margin = 0.05;
  int near = 0;
  for (int trial = 0; trial < 300; ++trial) {
    auto poses = initial_poses(scene);
    Vec3 direction;  // one statement per number: the order of arguments depends on the compiler
    for (int k = 0; k < 3; ++k) direction[k] = normal(random);
    Eigen::Vector4d rotation;
    for (int k = 0; k < 4; ++k) rotation[k] = normal(random);
    poses[1].p_WB = distance(random) * direction.normalized();
    poses[1].q_WB = Quaterniond(rotation.normalized());
    const Nearest nearest = sampled_distance(poses[0], poses[1], 60);
    const double expected = nearest.distance;
    const ContactSet set = ContactDetector(scene, options).update(poses);
    double gap = 1e300;
    for (const Contact& contact : set.points) gap = std::min(gap, contact.gap);
    const double sampling = 1.0 / 60;  // distance of the nearest point from the grid
    const bool at_vertex = nearest.faces_a + nearest.faces_b > 4;
    if (expected > sampling && expected < options.margin && !at_vertex) {
      ++near;
      ASSERT_FALSE(set.points.empty()) << trial << " at " << expected;
      if (std::min(nearest.faces_a, nearest.faces_b) == 1) {
        EXPECT_LT(gap, expected + 1e-12) << trial;
      }
    }
    if (expected > 2 * options.margin) {
      EXPECT_TRUE(set.points.empty()) << trial << " at " << expected;
    }
  }
  EXPECT_GT(near, 10);
}

/// Adds a part to the last block, between y = from and to, with the outline (x, z), counter-clockwise as seen
/// from -y.
void add_prism_part(const std::vector<Vec2>& outline, double from, double to, Assembly* assembly) {
  Part part;
  part.block = static_cast<int>(assembly->blocks.size()) - 1;
  part.face_start = assembly->num_faces();
  assembly->parts.push_back(part);
  const int first = static_cast<int>(assembly->vertices.size()), n = static_cast<int>(outline.size());
  std::vector<int> front, back;
  for (int i = 0; i < n; ++i) {
    for (const double y : {from, to}) assembly->vertices.emplace_back(outline[i].x(), y, outline[i].y());
    front.push_back(first + 2 * i);
    back.insert(back.begin(), first + 2 * i + 1);
    const int next = (i + 1) % n;
    assembly->add_face({{first + 2 * next, first + 2 * i, first + 2 * i + 1, first + 2 * next + 1}},
                       FaceKind::bed);
  }
  assembly->add_face(front, FaceKind::head);
  assembly->add_face(back, FaceKind::head);
}

void add_prism(const std::vector<Vec2>& outline, bool fixed, Assembly* assembly) {
  add_block({.fixed = fixed}, assembly);
  add_prism_part(outline, 0.0, 1.0, assembly);
}

// The bottom of a stone on a slope is parallel to it from x = 1 to 2, and level from 0.4 to 1, where it hangs
// over the slope. Both faces touch the slope in the edge between them, and the bed is the joint: wherever the
// model lies, in either order of the blocks, mirrored, and with coordinates rounded to 1e-6 m.
TEST(EdgeContact, OfFacesThatMeetInAnEdgeTheParallelOneIsTheJoint) {
  for (const double slope : {6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 19.0})
    for (const double shift : {0.0, 7.3})
      for (const bool stone_first : {false, true})
        for (const double mirror : {1.0, -1.0})
          for (const double rounding : {0.0, 1e-6}) {
            const double t = std::tan(slope * kPi / 180.0), x = shift;
            std::vector<Vec2> floor{{x, 0}, {x + 3, 0}, {x + 3, 0.2 + 3 * t}, {x, 0.2}};
            std::vector<Vec2> stone{
                {x + 0.4, 0.2 + t}, {x + 1, 0.2 + t}, {x + 2, 0.2 + 2 * t}, {x + 2, 2.2}, {x + 0.4, 2.2}};
            for (std::vector<Vec2>* outline : {&floor, &stone}) {
              for (Vec2& corner : *outline) {
                corner.x() *= mirror;
                if (rounding > 0.0) corner = (corner / rounding).array().round() * rounding;
              }
              if (mirror < 0.0) std::ranges::reverse(*outline);
            }
            Assembly scene;
            if (stone_first) add_prism(stone, false, &scene);
            add_prism(floor, true, &scene);
            if (!stone_first) add_prism(stone, false, &scene);
            compute_mass_properties(&scene);
            const ContactSet set = ContactDetector(scene, {}).update(initial_poses(scene));
            ASSERT_EQ(set.patches.size(), 1u) << slope;
            EXPECT_NEAR(set.patches[0].area, std::hypot(1.0, t), 1e-12 + 4.0 * rounding)
                << slope << " " << shift << " " << stone_first << " " << mirror << " " << rounding;
          }
}

// A stone whose underside is a roof lies on one slope of it, and its ridge hooks over the edge of the support:
// that presses on the other slope. However the stone is split, and mirrored.
TEST(EdgeContact, AtAReentrantEdgeDependsOnNoSplit) {
  using Outlines = std::vector<std::vector<Vec2>>;
  const Outlines left_plane_continued{{{0, 0}, {2, 1.2}, {2, 1.6}, {0, 1.6}}, {{1, 0.6}, {2, 0}, {2, 1.2}}};
  const Outlines right_plane_continued{{{2, 0}, {2, 1.6}, {0, 1.6}, {0, 1.2}}, {{0, 0}, {1, 0.6}, {0, 1.2}}};
  const Outlines upright{{{0, 0}, {1, 0.6}, {1, 1.6}, {0, 1.6}}, {{1, 0.6}, {2, 0}, {2, 1.6}, {1, 1.6}}};
  const std::vector<Vec2> under_left{{0, -1}, {1, -1}, {1, 0.6}, {0, 0}};
  for (const Outlines& parts : {left_plane_continued, right_plane_continued, upright})
    for (const bool mirrored : {false, true})
      for (const std::vector<double>& slices : {std::vector<double>{0, 1}, {0, 0.3, 1}}) {
        std::vector<Vec2> support = under_left;
        for (Vec2& corner : support)
          if (mirrored) corner.x() = 2.0 - corner.x();
        if (mirrored) std::ranges::reverse(support);
        Assembly scene;
        add_prism(support, false, &scene);
        add_block({}, &scene);
        for (std::size_t i = 0; i + 1 < slices.size(); ++i)
          for (const auto& part : parts) add_prism_part(part, slices[i], slices[i + 1], &scene);
        compute_mass_properties(&scene);
        const ContactSet set = ContactDetector(scene, {}).update(initial_poses(scene));
        ASSERT_EQ(set.patches.size(), 2u);
        const int edge = set.patches[0].area == 0.0 ? 0 : 1;
        for (const Patch& patch : set.patches) EXPECT_EQ(patch.kind, JointKind::bed);
        EXPECT_NEAR(set.patches[1 - edge].area, std::hypot(1.0, 0.6), 1e-12);  // rounding, also below
        ASSERT_EQ(set.points.size(), 6u);
        for (const Contact& contact : set.points) {
          if (contact.patch != edge) continue;
          EXPECT_LT((contact.point_a - Vec3(1.0, std::round(contact.point_a.y()), 0.6)).norm(), 1e-12);
          EXPECT_LT((contact.normal - Vec3(mirrored ? -0.6 : 0.6, 0, 1).normalized()).norm(), 1e-12);
        }
      }
}

// A cube turned by 30 degrees whose lowest edge, between bed and head, stands on the bed of another, or leans
// on its head.
TEST(EdgeContact, IsOfTheJointWhoseFacesMeet) {
  const Quaterniond turned(AngleAxisd(kPi / 6, Vec3::UnitY()));
  const double reach = 0.5 * (std::cos(kPi / 6) + std::sin(kPi / 6));  // of an edge from the centroid
  const struct {
    Vec3 center;
    JointKind kind;
  } places[] = {{{0, 0, 0.5 + reach}, JointKind::bed}, {{0.5 + reach, 0, 0}, JointKind::head}};
  for (const auto& place : places) {
    const Assembly scene = make_boxes({{}, {.center = place.center, .rotation = turned}});
    const ContactSet set = ContactDetector(scene, {}).update(initial_poses(scene));
    ASSERT_EQ(set.patches.size(), 1u);
    EXPECT_EQ(set.patches[0].area, 0.0);
    EXPECT_EQ(set.patches[0].kind, place.kind);
  }
}

// A stone slides over the border between both parts of its support, in which it sinks a little. Its sides
// pass the sides of the parts inside the support, where there is nothing to press against.
TEST(EdgeContact, AStoneSlidesOverPartsOfItsSupport) {
  for (const double overhang : {-0.4, 0.0, 0.4})
    for (const double split : {-0.5, 0.0, 0.5})
      for (const double depth : {0.0, 1e-6, 1e-4, 2e-3})
        for (const double along : {-1e-2, -1e-3, -1e-5, 0.0, 1e-5, 1e-3, 1e-2})
          for (const bool stone_first : {false, true})
            for (const double y : {0.0, 0.7}) {
              const std::vector<Vec2> stone{{along, -depth},
                                            {along + 1, -depth},
                                            {along + 1 + overhang, 1 - depth},
                                            {along + overhang, 1 - depth}};
              Assembly scene;
              const auto add_stone = [&] {
                add_block({}, &scene);
                add_prism_part(stone, y, y + 0.5, &scene);
              };
              if (stone_first) add_stone();
              add_prism({{-2, -1}, {split, -1}, {0, 0}, {-2, 0}}, true, &scene);
              add_prism_part({{split, -1}, {2, -1}, {2, 0}, {0, 0}}, 0.0, 1.0, &scene);
              if (!stone_first) add_stone();
              compute_mass_properties(&scene);
              const ContactSet set = ContactDetector(scene, {}).update(initial_poses(scene));
              EXPECT_FALSE(set.points.empty());
              for (const Contact& contact : set.points)
                EXPECT_GT(std::abs(contact.normal.z()), 1.0 - 1e-9)
                    << overhang << " " << split << " " << depth << " " << along << " " << stone_first << " "
                    << y << ": " << contact.normal.transpose();
            }
}

}  // namespace
}  // namespace cupola::edge_test
