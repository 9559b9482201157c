// Thrust lines and sums of the wythes of a vault: two leaves in the rings 0 and 3, bonders through both in
// the rings 1 and 2.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "postproc/mechanics/thrust_line.hpp"
#include "postproc/mechanics/wythe_sums.hpp"
#include "tests/postproc/models.hpp"

namespace cupola::wythe_lines_test {
namespace {

constexpr int kRings = 4, kPerRing = 12;
constexpr double kRadii[] = {10.0, 10.4, 11.0};  // m, of the layers
constexpr double kTilt = 0.02;                   // rad, from bed to bed

bool is_bonded(int ring) {
  return ring == 1 || ring == 2;
}

Vec3 point(double radius, int bed, double angle) {
  const double rho = radius * std::cos(kTilt * bed) - 3.0;
  return {rho * std::cos(angle), rho * std::sin(angle), radius * std::sin(kTilt * bed)};
}

/// In the middle of the bed of a block.
Vec3 middle(double radius, int bed, int slot) {
  const double width = 2.0 * std::numbers::pi / kPerRing;
  return 0.5 * (point(radius, bed, slot * width) + point(radius, bed, (slot + 1) * width));
}

void add_block(Assembly* a, int ring, int slot, WytheRange wythes) {
  const double width = 2.0 * std::numbers::pi / kPerRing;
  for (int i = 0; i < 8; ++i) {
    const int layer = i & 1 ? wythes.to : wythes.from;
    a->vertices.push_back(point(kRadii[layer], ring + (i & 4 ? 1 : 0), (slot + (i & 2 ? 1 : 0)) * width));
    a->vertex_layers.push_back(layer);
    a->vertex_depths.push_back(kRadii[layer] - kRadii[0]);
  }
  Block block;
  block.ring = ring;
  block.slot = slot;
  block.density = 1800.0;
  a->blocks.push_back(block);
  using enum FaceKind;
  test::add_hexahedron(a, static_cast<int>(a->blocks.size()) - 1, ring,
                       {bed, ring + 1 == kRings ? top : bed, wythes.from == 0 ? intrados : wythe,
                        wythes.to == 2 ? extrados : wythe, head, head});
  a->parts.back().slice = slot;
  a->parts.back().wythe = wythes.from;
}

/// The blocks of one ring and slot, by wythe: the same one twice if it is a bonder. Block 0 is the support.
std::array<int, 2> blocks_at(int ring, int slot) {
  int first = 1;
  for (int k = 0; k < ring; ++k) first += is_bonded(k) ? kPerRing : 2 * kPerRing;
  if (is_bonded(ring)) return {first + slot, first + slot};
  return {first + 2 * slot, first + 2 * slot + 1};
}

Assembly two_leaves() {
  Assembly a;
  a.num_rings = kRings;
  a.members = {"inner", "outer", "bonder"};
  Block support;
  support.fixed = true;
  support.ring = -1;
  support.density = 1800.0;
  a.blocks.push_back(support);
  test::add_box(&a, 0, -1, {-1, -1, -1}, {1, 1, -0.5}, FaceKind::bed);
  a.vertex_layers.assign(8, -1);
  a.vertex_depths.assign(8, 0.0);
  for (int ring = 0; ring < kRings; ++ring)
    for (int slot = 0; slot < kPerRing; ++slot) {
      if (is_bonded(ring)) {
        add_block(&a, ring, slot, {0, 2});
        continue;
      }
      add_block(&a, ring, slot, {0, 1});
      add_block(&a, ring, slot, {1, 2});
    }
  compute_mass_properties(&a);
  return a;
}

JointWrench bed_joint(int lower, int upper, int ring, const Vec3& at, const Vec3& force) {
  JointWrench joint;
  joint.block_a = lower;
  joint.block_b = upper;
  joint.lower = lower;
  joint.upper = joint.carried = upper;
  joint.ring = ring;
  joint.kind = lower == 0 ? JointKind::base : JointKind::bed;
  joint.wrench = {at, force, Vec3::Zero()};
  return joint;
}

/// A force in every joint, in the plane of its slot: `outward` and `upward`, N, at the share `position` of
/// the wythe.
struct Push {
  double outward, upward, position;
  Vec3 force(int slot) const {
    const double angle = (slot + 0.5) * 2.0 * std::numbers::pi / kPerRing;
    return {outward * std::cos(angle), outward * std::sin(angle), upward};
  }
};
constexpr Push kInner{-300.0, 1000.0, 0.25}, kOuter{120.0, 400.0, 0.8};

/// N, component of a force across a bed in its meridian plane.
double across(const Push& push, int bed) {
  return -std::sin(kTilt * bed) * push.outward + std::cos(kTilt * bed) * push.upward;
}

struct Scene {
  Assembly assembly = two_leaves();
  Shell shell = shell_of(assembly, Vec3::UnitZ());
  ContactTable contacts;
  JointWrenches joints;

  /// A joint with one contact point.
  void add(int lower, int upper, int ring, const Vec3& at, const Vec3& force, double normal_force) {
    JointWrench joint = bed_joint(lower, upper, ring, at, force);
    joint.contact_start = contacts.size();
    joint.num_contacts = 1;
    joint.normal_force = normal_force;
    joint.centre_of_pressure = at;
    joint.area = 0.5;
    joints.contacts.push_back(contacts.size());
    joints.wrenches.push_back(joint);
    contacts.joint.push_back(contacts.size());
    contacts.point.push_back(at);
    contacts.force.push_back(force);
    contacts.normal_force.push_back(normal_force);
    contacts.area.push_back(0.5);
  }

  Scene() {
    for (int ring = 0; ring < kRings; ++ring)
      for (int slot = 0; slot < kPerRing; ++slot) {
        const auto upper = blocks_at(ring, slot);
        const auto lower = ring == 0 ? std::array{0, 0} : blocks_at(ring - 1, slot);
        const auto at = [&](int wythe, double position) {
          const double from = kRadii[wythe], to = kRadii[wythe + 1];
          return middle(from + position * (to - from), ring, slot);
        };
        if (upper[0] == upper[1] && lower[0] == lower[1] && lower[0] != 0) {
          add(lower[0], upper[0], ring, at(0, 0.5), kInner.force(slot) + kOuter.force(slot),
              across(kInner, ring) + across(kOuter, ring));
          continue;
        }
        for (const int wythe : {0, 1}) {
          const Push& push = wythe == 0 ? kInner : kOuter;
          add(lower[wythe], upper[wythe], ring, at(wythe, push.position), push.force(slot),
              across(push, ring));
        }
      }
    index_by_block(assembly.blocks.size(), &joints);
  }
  ThrustInput input() const {
    return {&assembly, &shell, &contacts, &joints, wrenches_from_below(assembly, joints), {0, 0, -9.81}};
  }
};

TEST(WytheLines, TakeTheJointsOfTheirWythe) {
  const Scene scene;
  ASSERT_EQ(scene.shell.num_wythes, 2);
  for (const double azimuth : {15.0, 0.0, 37.0}) {  // middle of a block, head joint, in between
    const ThrustLine lines[] = {thrust_line(scene.input(), "inner", azimuth, 0),
                                thrust_line(scene.input(), "outer", azimuth, 1)};
    for (const int wythe : {0, 1}) {
      const Push& push = wythe == 0 ? kInner : kOuter;
      ASSERT_EQ(lines[wythe].points.size(), 3u) << "a bonder on a bonder divides no force";
      for (int i = 0; i < 3; ++i) {
        const ThrustPoint& p = lines[wythe].points[i];
        EXPECT_EQ(p.bed, (std::array{0, 1, 3})[i]);
        EXPECT_NEAR(p.position, push.position, 1e-10);
        EXPECT_NEAR(p.r, std::hypot(push.outward, push.upward), 1e-9);
        EXPECT_NEAR(p.v, push.upward, 1e-9);
        EXPECT_NEAR(p.geometric_safety, 0.5 / std::abs(push.position - 0.5), 1e-8);
      }
      EXPECT_EQ(lines[wythe].runs().size(), 1u) << "beds 0 and 1; bed 3 alone is no line";
    }
  }
}

TEST(WytheLines, AddUpToTheWholeThickness) {
  const Scene scene;
  for (const double azimuth : {15.0, 0.0, 37.0}) {
    const ThrustLine whole = thrust_line(scene.input(), "m", azimuth);
    const ThrustLine inner = thrust_line(scene.input(), "inner", azimuth, 0);
    const ThrustLine outer = thrust_line(scene.input(), "outer", azimuth, 1);
    ASSERT_EQ(whole.points.size(), 4u);
    for (const int bed : {0, 1, 3}) {
      const ThrustPoint &w = whole.points[bed], &i = inner.points[bed == 3 ? 2 : bed],
                        &o = outer.points[bed == 3 ? 2 : bed];
      EXPECT_LT((w.force - i.force - o.force).norm(), 1e-12 * w.r) << "rounding of sums of forces";
      EXPECT_LT((w.intrados - i.intrados).norm() + (i.extrados - o.intrados).norm() +
                    (w.extrados - o.extrados).norm(),
                1e-12);
      // Shares of the thickness: the inner wythe takes 0.4 of it.
      const double n_i = across(kInner, bed), n_o = across(kOuter, bed);
      EXPECT_NEAR(w.position,
                  (n_i * 0.4 * kInner.position + n_o * (0.4 + 0.6 * kOuter.position)) / (n_i + n_o), 1e-10);
    }
    EXPECT_NEAR(whole.points[2].position, 0.2, 1e-10) << "in the middle of the inner wythe";
  }
}

// Per slot: 1000 N inside, 400 N outside, at 0.25 and 0.8 of the wythe.
TEST(WytheSums, AddUpToTheRingAndKnowWhereTheyAct) {
  const Scene scene;
  const std::vector<WytheSum> sums = wythe_sums(scene.assembly, scene.shell, scene.joints, scene.contacts);
  ASSERT_EQ(sums.size(), 7u) << "two per ring; ring 2 stands on bonders";
  const auto sum = [&](size_t i, int ring, WytheRange wythes) {
    EXPECT_EQ(sums[i].ring, ring);
    EXPECT_EQ(sums[i].wythes, wythes);
    EXPECT_EQ(sums[i].joints, kPerRing);
    EXPECT_NEAR(sums[i].area, 0.5 * kPerRing, 1e-12);
    return sums[i];
  };
  for (const size_t first : {0u, 2u, 5u}) {
    const int ring = first == 5 ? 3 : static_cast<int>(first) / 2;
    const WytheSum inner = sum(first, ring, {0, 1}), outer = sum(first + 1, ring, {1, 2});
    EXPECT_NEAR(inner.vertical_force, 1000.0 * kPerRing, 1e-8);
    EXPECT_NEAR(outer.vertical_force, 400.0 * kPerRing, 1e-8);
    EXPECT_NEAR(inner.share, 1.0 / 1.4, 1e-12);
    EXPECT_NEAR(inner.share + outer.share, 1.0, 1e-15);
    EXPECT_NEAR(inner.position, kInner.position, 1e-10);
    EXPECT_NEAR(outer.position, kOuter.position, 1e-10);
    EXPECT_NEAR(inner.pressure, across(kInner, ring) / 0.5, 1e-9);
    EXPECT_NEAR(inner.cv_pressure, 0.0, 1e-12);
  }
  JointWrenches negligible = scene.joints;
  for (size_t j = 0; j < negligible.wrenches.size(); ++j) {
    negligible.wrenches[j].negligible = true;
    negligible.wrenches[j].normal_force *= static_cast<double>(1 + j % 2);  // rounding differs
  }
  for (const WytheSum& none : wythe_sums(scene.assembly, scene.shell, negligible, scene.contacts))
    EXPECT_EQ(none.cv_pressure, 0.0);
  const WytheSum both = sum(4, 2, {0, 2});
  EXPECT_NEAR(both.vertical_force, 1400.0 * kPerRing, 1e-8);
  EXPECT_NEAR(both.position, 0.2, 1e-10) << "of the whole thickness";
}

TEST(WytheLines, ABonderLiesInAllItsWythes) {
  const Scene scene;
  EXPECT_EQ(scene.shell.wythes[0], (WytheRange{0, 2})) << "the support";
  for (const JointWrench& joint : scene.joints.wrenches) {
    const WytheRange range = wythes_of(scene.assembly, scene.shell, joint);
    EXPECT_EQ(range.count(), joint.ring == 2 ? 2 : 1);
  }
  JointWrench between = bed_joint(blocks_at(0, 0)[0], blocks_at(3, 0)[1], 3, Vec3::Zero(), Vec3::UnitX());
  EXPECT_EQ(wythes_of(scene.assembly, scene.shell, between), (WytheRange{1, 2})) << "that of the higher ring";
}

TEST(Wythes, AreMovedApartThroughTheThickness) {
  const Scene scene;
  const std::vector<Vec3> shifts = shifts_by_wythe(scene.assembly, scene.shell);
  const auto [inner, outer] = blocks_at(0, 0);
  const Vec3 outwards = middle(kRadii[1], 0, 0) - middle(kRadii[0], 0, 0);
  EXPECT_EQ(shifts[0], Vec3::Zero()) << "the support";
  EXPECT_EQ(shifts[inner], Vec3::Zero());
  EXPECT_LT((shifts[outer] - outwards.normalized()).norm(), 1e-12);
  EXPECT_NEAR(shifts[blocks_at(1, 0)[0]].norm(), 0.5, 1e-12) << "a bonder stays between both";
  EXPECT_EQ(scene.shell.most_wythes(), 2);
  EXPECT_FALSE(scene.shell.is_alone(0) || scene.shell.is_alone(1));
}

}  // namespace
}  // namespace cupola::wythe_lines_test
