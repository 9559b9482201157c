#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/collision/contact_detector.hpp"
#include "solver/runtime/threads.hpp"
#include "tests/solver/scenes.hpp"

namespace cupola::detector_test {
namespace {

using namespace testing;  // the scenes
using Eigen::AngleAxisd;
using Eigen::Quaterniond;

ContactSet contacts_at_rest(const Assembly& assembly, PatchPoints points = PatchPoints::corners) {
  DetectionOptions options;
  options.sampling.points = points;
  return ContactDetector(assembly, options).update(initial_poses(assembly));
}

double total_area(const ContactSet& set, JointKind kind) {
  double area = 0.0;
  for (const Patch& patch : set.patches)
    if (patch.kind == kind) area += patch.area;
  return area;
}

Eigen::Isometry3d some_motion(const Vec3& shift) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  motion.translation() = shift;
  return motion;
}

TEST(ContactDetector, FindsTheCornersOfABoxOnASlab) {
  const Assembly scene = box_on_floor(Vec3(1, 2, 3));
  const ContactSet set = contacts_at_rest(scene);
  ASSERT_EQ(set.patches.size(), 1u);
  EXPECT_EQ(set.patches[0].kind, JointKind::base);
  EXPECT_NEAR(set.patches[0].area, 2.0, 1e-14);
  ASSERT_EQ(set.points.size(), 4u);
  for (const Contact& contact : set.points) {
    EXPECT_EQ(contact.block_a, 0);
    EXPECT_EQ(contact.block_b, 1);
    EXPECT_LT((contact.normal - Vec3::UnitZ()).norm(), 1e-15);  // from the slab to the box
    EXPECT_NEAR(contact.gap, 0.0, 1e-15);
    EXPECT_NEAR(std::abs(contact.point_b.x()), 0.5, 1e-15);
    EXPECT_NEAR(std::abs(contact.point_b.y()), 1.0, 1e-15);
  }
}

// A stone of the last course on the far support of an arch. Beside a support, a stone of two courses has one
// joint, of its first course.
TEST(ContactDetector, JointsOnSupportsAreOfTheCourseOfTheStone) {
  using namespace testing;
  const ContactSet far_end = contacts_at_rest(
      make_boxes({{.center = {0, 0, -0.5}, .fixed = true}, {.center = {0, 0, 0.5}, .ring = 10}}));
  ASSERT_EQ(far_end.patches.size(), 1u);
  EXPECT_EQ(far_end.patches[0].ring, 10);
  Assembly beside = make_boxes({{.center = {-1, 0, 0}, .size = {1, 1, 4}, .fixed = true}});
  add_block({.ring = 2}, &beside);
  for (const int ring : {2, 3}) {
    add_box_part({.center = {0, 0, ring - 2.5}}, false, false, &beside);
    beside.parts.back().ring = ring;
  }
  compute_mass_properties(&beside);
  const ContactSet at_side = contacts_at_rest(beside);
  ASSERT_EQ(at_side.patches.size(), 1u);
  EXPECT_EQ(at_side.patches[0].ring, 2);
  EXPECT_EQ(at_side.points.size(), 4u);
}

TEST(ContactDetector, QuadratureWeightsSumToTheArea) {
  const ContactSet set = contacts_at_rest(box_on_floor(Vec3(1, 2, 3)), PatchPoints::quadrature);
  ASSERT_EQ(set.points.size(), 5u);
  double area = 0.0;
  for (const Contact& contact : set.points) area += contact.area;
  EXPECT_NEAR(area, 2.0, 1e-14);
}

TEST(ContactDetector, FindsEveryJointOfAWall) {
  const int nb = 4, courses = 5;
  const Assembly scene = running_bond_wall(Vec3(1.2, 1.0, 0.3), nb, courses);
  const ContactSet set = contacts_at_rest(scene);
  // Running bond: each bed consists of 2 nb rectangles; odd courses have one more head joint.
  const int beds = nb + (courses - 1) * 2 * nb;
  const int heads = 3 * (nb - 1) + 2 * nb;
  EXPECT_EQ(set.patches.size(), static_cast<std::size_t>(beds + heads));
  EXPECT_EQ(set.points.size(), 4 * set.patches.size());
  EXPECT_NEAR(total_area(set, JointKind::base), nb * 1.2, 1e-12);
  EXPECT_NEAR(total_area(set, JointKind::bed), (courses - 1) * nb * 1.2, 1e-12);
  EXPECT_NEAR(total_area(set, JointKind::head), heads * 0.3, 1e-12);
  for (const Patch& patch : set.patches) {
    EXPECT_LT(patch.block_a, patch.block_b);
    const bool base = patch.kind == JointKind::base;
    EXPECT_EQ(patch.ring, base ? 0 : scene.blocks[patch.block_b].ring);
  }
  EXPECT_TRUE(std::is_sorted(set.points.begin(), set.points.end(), [](const Contact& p, const Contact& q) {
    return std::tuple(p.block_a, p.block_b, p.id) < std::tuple(q.block_a, q.block_b, q.id);
  }));
}

TEST(ContactDetector, MovedScaledAndFarScenesHaveTheSameContacts) {
  const Assembly reference = running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 4, 2);
  const ContactSet expected = contacts_at_rest(reference);
  for (const double scale : {1e-3, 1.0, 1e3}) {
    for (const double distance : {0.0, 1e6 * scale}) {
      const Eigen::Isometry3d motion = some_motion(distance * Vec3(1, -1, 0.5));
      const Assembly scene = transformed(reference, motion, scale);
      const ContactSet set = contacts_at_rest(scene);
      ASSERT_EQ(set.points.size(), expected.points.size()) << "scale " << scale << ", at " << distance;
      // Corners are stored with an error of eps * distance; a few of these add up in a gap or a lever arm.
      const double rounding = 2.2e-16 * (20 * scale + 8 * distance);
      for (std::size_t i = 0; i < set.points.size(); ++i) {
        const Contact& contact = set.points[i];
        EXPECT_EQ(contact.block_a, expected.points[i].block_a);
        EXPECT_NEAR(contact.gap, 0.0, rounding);
        EXPECT_NEAR(contact.area, expected.points[i].area * scale * scale, 4 * scale * rounding);
        EXPECT_LT((contact.normal - motion.linear() * expected.points[i].normal).norm(),
                  20 * rounding / scale);
      }
    }
  }
}

TEST(ContactDetector, FixedPairsAndInternalFacesMakeNoContact) {
  const BoxSpec low{.center = {0.5, 0.5, 0.5}, .fixed = true};
  const BoxSpec high{.center = {1.5, 0.5, 0.5}};
  BoxSpec high_fixed = high;
  high_fixed.fixed = true;
  EXPECT_EQ(contacts_at_rest(make_boxes({low, high})).patches.size(), 1u);
  EXPECT_TRUE(contacts_at_rest(make_boxes({low, high_fixed})).patches.empty());

  Assembly internal = make_boxes({low});
  add_block(high, &internal);
  add_box_part(high, true, false, &internal);
  compute_mass_properties(&internal);
  EXPECT_TRUE(contacts_at_rest(internal).patches.empty());
}

TEST(ContactDetector, FindsGapsWithinTheMarginOnly) {
  DetectionOptions options;
  options.margin = 1e-3;
  const Assembly scene = box_on_floor(Vec3(1, 1, 1));
  for (const double gap : {-5e-4, 0.0, 5e-4, 1e-3 - 1e-9, 1e-3 + 1e-9}) {
    auto poses = initial_poses(scene);
    poses[1].p_WB.z() += gap;
    const ContactSet set = ContactDetector(scene, options).update(poses);
    if (gap <= options.margin) {
      ASSERT_EQ(set.points.size(), 4u) << gap;
      for (const Contact& contact : set.points) EXPECT_NEAR(contact.gap, gap, 1e-15);
    } else {
      EXPECT_TRUE(set.points.empty()) << gap;
    }
  }
}

TEST(ContactDetector, LosesTheContactOfABoxThatSlidesOffAnEdge) {
  // The upper box slides along x. Below the sliver width of 1e-3 there is no face contact.
  const Assembly scene = stack_of_cubes(1.0, {1000.0, 1000.0});
  for (const double overlap : {0.5, 0.1, 1e-2, 1e-3 + 1e-9}) {
    auto poses = initial_poses(scene);
    poses[2].p_WB.x() += 1.0 - overlap;
    const ContactSet moved = ContactDetector(scene, {}).update(poses);
    ASSERT_EQ(moved.points.size(), 8u) << overlap;
    EXPECT_NEAR(moved.patches[1].area, overlap, 1e-12);
    EXPECT_EQ(moved.patches[1].kind, JointKind::bed);
  }
  // Just below the sliver width, on the edge, just on each side of it, and clear of it: no contact.
  for (const double overlap : {1e-3 - 1e-9, 1e-9, 0.0, -1e-9, -1e-3}) {
    auto poses = initial_poses(scene);
    poses[2].p_WB.x() += 1.0 - overlap;
    EXPECT_EQ(ContactDetector(scene, {}).update(poses).points.size(), 4u) << overlap;
  }
}

// A box that rocks on its edge touches at two points, with the normal of the slab and the exact gap.
TEST(ContactDetector, RockingBoxTouchesAlongItsEdge) {
  const Assembly scene = box_on_floor(Vec3(0.4, 1, 2));
  ContactDetector detector(scene, {});
  for (int step = 0; step <= 100; ++step) {
    const double angle = 0.002 * step;  // to 0.2 rad, the slenderness of this block
    auto poses = initial_poses(scene);
    const Vec3 hinge(0.2, 0, 0);
    poses[1].q_WB = AngleAxisd(angle, Vec3::UnitY());
    poses[1].p_WB = hinge + poses[1].q_WB * (poses[1].p_WB - hinge);
    const ContactSet& set = detector.update(poses);
    int touching = 0;
    for (const Contact& contact : set.points) {
      EXPECT_LT((contact.normal - Vec3::UnitZ()).norm(), 1e-12) << angle;
      const double height = contact.point_b.x() < 0 ? 0.4 * std::sin(angle) : 0.0;
      EXPECT_NEAR(contact.gap, height, 1e-12) << angle;
      touching += std::abs(contact.gap) < 1e-12;
    }
    EXPECT_EQ(touching, step == 0 ? 4 : 2) << angle;
  }
}

TEST(ContactDetector, CarriesContactsAlongUntilABlockHasMoved) {
  const Assembly scene = box_on_floor(Vec3(1, 1, 1));
  ContactDetector detector(scene, {});
  auto poses = initial_poses(scene);
  detector.update(poses);
  detector.update(poses);
  EXPECT_EQ(detector.num_detections(), 1);
  const double small = 0.2 * detector.margin();
  poses[1].p_WB += Vec3(0, 0, small);
  for (const Contact& contact : detector.update(poses).points) EXPECT_NEAR(contact.gap, small, 1e-15);
  EXPECT_EQ(detector.num_detections(), 1);
  poses[1].p_WB += Vec3(small, 0, 0);
  EXPECT_EQ(detector.update(poses).points.size(), 4u);
  EXPECT_EQ(detector.num_detections(), 2);
}

// A wall that moves and turns as one body keeps its contacts: only motion between two blocks needs a new
// detection.
TEST(ContactDetector, BlocksThatMoveTogetherKeepTheirContacts) {
  const Assembly scene = running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 4);
  ContactDetector detector(scene, {});
  auto poses = initial_poses(scene);
  const std::vector<Contact> before = detector.update(poses).points;
  for (int step = 1; step <= 50; ++step) {
    const Quaterniond turn(AngleAxisd(0.02 * step, Vec3(1, 2, 3).normalized()));
    const Vec3 shift(0.05 * step, 0, 0.01 * step);  // 0.05 m is ten margins or more
    for (std::size_t b = 0; b < poses.size(); ++b) poses[b] = {turn * scene.blocks[b].centroid + shift, turn};
    const std::vector<Contact>& after = detector.update(poses).points;
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_TRUE(after[i].id == before[i].id);
      EXPECT_LT((after[i].point_a - turn * before[i].point_a - shift).norm(), 1e-14);
    }
  }
  EXPECT_EQ(detector.num_detections(), 1);
}

// Contacts computed for some pairs only, in random motion of all blocks: the same joints as those of a new
// detection, with points and gaps that differ by no more than the motion between two detections, a quarter of
// the margin.
TEST(ContactDetector, PairsComputedAgainAgreeWithANewDetection) {
  const Assembly scene = running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 4);
  ContactDetector detector(scene, {});
  auto poses = initial_poses(scene);
  detector.update(poses);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double moved = 0.25 * detector.margin();
  for (int step = 1; step <= 60; ++step) {
    for (std::size_t b = 1; b < poses.size(); ++b) {
      if (uniform(random) < 0.5) continue;
      poses[b].p_WB += 0.2 * moved * Vec3(uniform(random), uniform(random), 0.2 * uniform(random));
    }
    const ContactSet tracked = detector.update(poses);
    const ContactSet fresh = ContactDetector(scene, {}).update(poses);
    ASSERT_EQ(tracked.patches.size(), fresh.patches.size()) << step;
    ASSERT_EQ(tracked.points.size(), fresh.points.size()) << step;
    for (std::size_t i = 0; i < fresh.points.size(); ++i) {
      const Contact &one = tracked.points[i], &two = fresh.points[i];
      ASSERT_TRUE(one.block_a == two.block_a && one.block_b == two.block_b && one.patch == two.patch) << step;
      EXPECT_NEAR(one.gap, two.gap, 1e-14);  // the faces stay parallel
      const auto nearest = std::ranges::min(fresh.points, {}, [&](const Contact& x) {
        return x.patch == one.patch ? (x.point_a - one.point_a).norm() : 1.0;
      });
      EXPECT_LT((nearest.point_a - one.point_a).norm(), std::sqrt(2.0) * moved) << step;
    }
  }
  EXPECT_GT(detector.num_detections(), 5);
}

TEST(ContactDetector, IdentitiesSurviveDetection) {
  const Assembly scene = stack_of_cubes(1.0, {1000.0, 1000.0});
  ContactDetector detector(scene, {});
  auto poses = initial_poses(scene);
  ContactSet before = detector.update(poses);
  for (int step = 1; step <= 40; ++step) {
    poses[2].p_WB.x() += 0.01;
    poses[2].q_WB = AngleAxisd(0.01 * step, Vec3::UnitZ()) * Quaterniond::Identity();
    const ContactSet& after = detector.update(poses);
    // A point with a given identity moves no farther than its block, also when the overlap gains a corner.
    std::map<ContactId, Vec3> points;
    for (const Contact& contact : after.points) points.emplace(contact.id, contact.point_a);
    EXPECT_EQ(points.size(), after.points.size());
    int kept = 0;
    for (const Contact& contact : before.points) {
      if (!points.contains(contact.id)) continue;
      EXPECT_LT((contact.point_a - points[contact.id]).norm(), 0.05) << step;
      ++kept;
    }
    EXPECT_EQ(kept, std::min<int>(before.points.size(), after.points.size())) << step;
    before = after;
  }
  EXPECT_GT(detector.num_detections(), 30);
}

TEST(ContactDetector, TrackedContactsAgreeWithDetectedOnes) {
  const Assembly scene = running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 4);
  ContactDetector detector(scene, {});
  auto poses = initial_poses(scene);
  detector.update(poses);
  for (int step = 1; step <= 5; ++step) {
    for (std::size_t b = 1; b < poses.size(); ++b) {
      const double t = 0.3 * step * detector.margin();
      poses[b].p_WB.z() = scene.blocks[b].centroid.z() + t * scene.blocks[b].ring;
    }
    const ContactSet followed = detector.update(poses);
    const ContactSet fresh = ContactDetector(scene, {}).update(poses);
    ASSERT_EQ(followed.points.size(), fresh.points.size());
    for (std::size_t i = 0; i < fresh.points.size(); ++i) {
      EXPECT_EQ(followed.points[i].id, fresh.points[i].id);
      EXPECT_NEAR(followed.points[i].gap, fresh.points[i].gap, 1e-14);
    }
  }
}

// The slices of a block are coplanar in a wall: the joints are the same polygons for any number of slices.
TEST(ContactDetector, SlicesDoNotChangeTheJoints) {
  const ContactSet whole = contacts_at_rest(running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 4, 1));
  for (const int slices : {2, 4, 8}) {
    const ContactSet sliced = contacts_at_rest(running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 4, slices));
    ASSERT_EQ(sliced.patches.size(), whole.patches.size()) << slices;
    ASSERT_EQ(sliced.points.size(), whole.points.size()) << slices;
    for (std::size_t i = 0; i < whole.patches.size(); ++i) {
      EXPECT_EQ(sliced.patches[i].block_a, whole.patches[i].block_a);
      EXPECT_EQ(sliced.patches[i].block_b, whole.patches[i].block_b);
      EXPECT_NEAR(sliced.patches[i].area, whole.patches[i].area, 1e-12);
    }
  }
}

// Slabs k and k + 2 do not touch, although they also have opposed faces whose planes have passed each other.
// The stack is rotated, so that axis-aligned boxes cannot separate them.
TEST(ContactDetector, ThinSlabsTouchOnlyTheirNeighbours) {
  for (const double thickness : {0.2, 0.05, 0.02}) {
    std::vector<BoxSpec> slabs{{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true}};
    for (int k = 0; k < 20; ++k)
      slabs.push_back({.center = {0, 0, (k + 0.5) * thickness}, .size = {1, 1, thickness}, .ring = k});
    const Eigen::Isometry3d turn = some_motion(Vec3::Zero());
    const Assembly scene = transformed(make_boxes(slabs), turn);
    for (const double sunk : {0.0, 1e-3 * thickness, 0.2 * thickness}) {  // per joint
      for (const double tilt : {0.0, 1e-3, 1e-2}) {  // rad over the thickness, every other slab
        auto poses = initial_poses(scene);
        for (std::size_t k = 1; k < poses.size(); ++k) {
          poses[k].p_WB -= turn.linear().col(2) * (sunk * static_cast<double>(k));
          poses[k].q_WB = AngleAxisd(k % 2 ? tilt * thickness : 0.0, turn.linear().col(1));
        }
        const ContactSet set = ContactDetector(scene, {}).update(poses);
        EXPECT_EQ(set.patches.size(), 20u) << thickness << " " << sunk << " " << tilt;
        for (const Contact& contact : set.points) {
          EXPECT_EQ(contact.block_b, contact.block_a + 1) << thickness << " " << sunk << " " << tilt;
          EXPECT_NEAR(contact.gap, -sunk, 0.51 * tilt * thickness + 1e-12);
        }
      }
    }
  }
}

TEST(ContactDetector, RejectsInvalidOptions) {
  const Assembly scene = box_on_floor(Vec3(1, 1, 1));
  DetectionOptions options;
  options.margin = -1.0;
  EXPECT_THROW(ContactDetector(scene, options), InputError);
  options.margin = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ContactDetector(scene, options), InputError);
  options.margin = 0.0;
  options.moved_fraction = 0.5;
  EXPECT_THROW(ContactDetector(scene, options), InputError);
}

/// Two columns in contact at x = 0. Each consists of a part 1 m wide below a part of the given width.
Assembly two_columns(double upper_a, double upper_b) {
  Assembly columns;
  for (const auto& [x, upper] : {std::pair(-0.5, upper_a), std::pair(0.5, upper_b)}) {
    testing::BoxSpec part{.center = {x, 0, 0.5}, .size = {1, 1, 1}};
    testing::add_block(part, &columns);
    testing::add_box_part(part, false, false, &columns);
    part.center.z() = 1.5;
    part.size.y() = upper;
    testing::add_box_part(part, false, false, &columns);
  }
  compute_mass_properties(&columns);
  return columns;
}

// One column sinks along the other while their joint is compressed. Slivers of other pairs of parts are added
// to the patches, but every contact keeps its identity and its gap. New points start with zero gap and no
// force.
TEST(ContactDetector, ColumnSinkingAlongACompressedJointKeepsItsContacts) {
  // 0.8 and 0.8: the sliver between upper and lower part is merged with a patch; 0.6 and 0.8: it is a new
  // patch.
  for (const auto& [upper_a, num_after] : {std::pair(0.8, 8u), std::pair(0.6, 12u)}) {
    const Assembly columns = two_columns(upper_a, 0.8);
    ContactDetector detector(columns, {});
    std::vector<Pose> poses = initial_poses(columns);
    const std::vector<Contact> before = detector.update(poses).points;
    ASSERT_EQ(before.size(), 8u);
    poses[1].p_WB += Vec3(-5e-4, 0.0, -5e-3);
    const std::vector<Contact> after = detector.update(poses).points;
    EXPECT_EQ(after.size(), num_after);
    std::set<ContactId> known;
    for (const Contact& contact : before) known.insert(contact.id);
    size_t kept = 0;
    for (const Contact& contact : after) {
      kept += known.count(contact.id);
      EXPECT_NEAR(contact.gap, known.contains(contact.id) ? -5e-4 : 0.0, 1e-12);
    }
    EXPECT_EQ(kept, before.size());
    // A rest gap vanishes as the contact opens. Back at the initial poses every gap is the geometric one.
    poses = initial_poses(columns);
    for (const Contact& contact : detector.update(poses).points) EXPECT_NEAR(contact.gap, 0.0, 1e-12);
  }
}

// 60 x 60 bricks have about 20,000 pairs of boxes, enough work for several threads.
TEST(ContactDetector, GivesTheSameBitsWithAnyNumberOfThreads) {
  std::vector<BoxSpec> boxes{{.center = {30, 0, -0.5}, .size = {100, 3, 1}, .fixed = true}};
  for (int course = 0; course < 60; ++course)
    for (int k = 0; k < 60; ++k)
      boxes.push_back({.center = {k + 0.5 * (course % 2), 0, 0.3 * course + 0.15}, .size = {1, 1, 0.3}});
  const Assembly assembly = make_boxes(boxes);
  for (const bool gjk : {false, true}) {
    DetectionOptions options;
    if (gjk) options.perturbed_gjk = PerturbedGjkOptions{.perturbations = 4};
    std::vector<ContactSet> found;
    for (const int threads : {1, 3}) {
      set_num_threads(threads);
      found.push_back(ContactDetector(assembly, options).update(initial_poses(assembly)));
    }
    set_num_threads(1);
    ASSERT_EQ(found[0].points.size(), found[1].points.size());
    ASSERT_GT(found[0].points.size(), 4u * 3600u);
    for (std::size_t i = 0; i < found[0].points.size(); ++i) {
      const Contact &one = found[0].points[i], &three = found[1].points[i];
      EXPECT_TRUE(one.id == three.id && one.patch == three.patch && one.point_a == three.point_a &&
                  one.normal == three.normal && one.gap == three.gap && one.area == three.area)
          << "contact " << i << (gjk ? " by GJK" : " by clipping");
    }
  }
}

}  // namespace
}  // namespace cupola::detector_test
