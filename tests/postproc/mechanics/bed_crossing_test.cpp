#include "postproc/mechanics/bed_crossing.hpp"

#include <gtest/gtest.h>

#include "postproc/evaluation/meridians.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::bed_crossing_test {
namespace {

using test::kGravity;

/// A contact point with a force on block b.
void add_contact(ContactTable* c, int joint, int a, int b, JointKind kind, int ring, const Vec3& point,
                 const Vec3& normal, const Vec3& force) {
  c->joint.push_back(joint);
  c->block_a.push_back(a);
  c->block_b.push_back(b);
  c->kind.push_back(kind);
  c->ring.push_back(ring);
  c->point.push_back(point);
  c->normal.push_back(normal);
  c->force.push_back(force);
  c->normal_force.push_back(normal.dot(force));
  c->area.push_back(0.1);
  for (auto* v : {&c->gap, &c->friction_use, &c->slip, &c->law_violation}) v->push_back(0.0);
}

/// A block of two courses, of one part or of one a course, beside one block a course. 300 N of friction in
/// the head joint of course `hangs` hang its block on the tall one.
Evaluation tall_block(bool divided, int hangs) {
  Assembly a;
  a.num_rings = 2;
  a.sheets = {{.name = "wall", .num_rings = 2}};
  Block support, block;
  support.kind = BlockKind::support;
  support.fixed = true;
  support.ring = -1;
  a.blocks = {support, block, block, block};
  for (int b = 1; b < 4; ++b) a.blocks[b].density = 1000.0;
  a.blocks[1].num_rings = 2;
  a.blocks[3].ring = 1;
  using enum FaceKind;
  test::add_box(&a, 0, -1, {0, 0, -1}, {2, 1, 0}, bed);
  if (divided) {
    test::add_box(&a, 1, 0, {0, 0, 0}, {1, 1, 0.5}, internal);
    test::add_box(&a, 1, 1, {0, 0, 0.5}, {1, 1, 1}, top);
  } else {
    test::add_box(&a, 1, 0, {0, 0, 0}, {1, 1, 1}, top);
  }
  test::add_box(&a, 2, 0, {1, 0, 0}, {2, 1, 0.5}, bed);
  test::add_box(&a, 3, 1, {1, 0, 0.5}, {2, 1, 1}, top);
  compute_mass_properties(&a);
  const double w = 500.0 * kGravity, f = 300.0;
  Frame frame = test::column_at_rest(test::column(3), kGravity, 0.0, 0.6, 0.4);
  for (size_t b = 0; b < 4; ++b) frame.blocks.position[b] = a.blocks[b].centroid;
  ContactTable& c = frame.contacts = {};
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  add_contact(&c, 0, 0, 1, JointKind::base, 0, {0.5, 0.5, 0}, z, (2 * w + f) * z);
  add_contact(&c, 1, 0, 2, JointKind::base, 0, {1.5, 0.5, 0}, z, (2 * w - f) * z);
  add_contact(&c, 2, 2, 3, JointKind::bed, 1, {1.5, 0.5, 0.5}, z, (hangs == 1 ? w - f : w) * z);
  add_contact(&c, 3, 1, hangs == 1 ? 3 : 2, JointKind::head, hangs, {1, 0.5, hangs == 1 ? 0.75 : 0.25}, x,
              f * z);
  return test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                         test::fresh_folder("results"));
}

double vertical_sum(const Evaluation& e, int bed) {
  double sum = 0.0;
  for (const auto& [block, wrench] : wrenches_across(thrust_input(e, e.last), bed)) sum += wrench.force.z();
  return sum;
}

// Across bed 1: the weights of what lies above. A block of one part lies above it as a whole.
TEST(BedCrossing, CarriesWhatLiesAbove) {
  const double w = 500.0 * kGravity;
  for (const int hangs : {0, 1}) {
    EXPECT_NEAR(vertical_sum(tall_block(true, hangs), 0), 4 * w, 1e-9 * w);  // rounding
    EXPECT_NEAR(vertical_sum(tall_block(true, hangs), 1), 2 * w, 1e-9 * w) << hangs;
    EXPECT_NEAR(vertical_sum(tall_block(false, hangs), 1), 3 * w, 1e-9 * w) << hangs;
  }
}

}  // namespace
}  // namespace cupola::bed_crossing_test
