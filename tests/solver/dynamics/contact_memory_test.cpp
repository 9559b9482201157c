#include "solver/dynamics/contact_memory.hpp"

#include <gtest/gtest.h>

namespace cupola::contact_memory_test {
namespace {

Contact contact_at(double x, int corner) {
  Contact contact;
  contact.id = {0, 1, 0, 0, corner};
  contact.block_b = 1;
  contact.point_a = Vec3(x, 0, 0);
  contact.gap = -1e-6;
  return contact;
}

// A joint is cracked and has slipped at its heel, x = 0, and is sound at its toe. When it gets more points,
// each takes over what was at its place, while block a has moved by 5 m.
TEST(ContactMemory, StaysInItsPlaceWhenAJointGetsMorePoints) {
  ContactMemories before = match_memories({}, {contact_at(0.0, -2), contact_at(1.0, -1)});
  const Pose built, moved{Vec3(5, 0, 0), Eigen::Quaterniond::Identity()};
  ContactMemory &heel = before.stored()[0], &toe = before.stored()[1];
  heel.point_A = place_on(built, contact_at(0.0, -2));
  toe.point_A = place_on(built, contact_at(1.0, -1));
  heel.joint.damage = 1.0;
  heel.elastic_slip_A = Vec3(0, 1e-5, 0);
  heel.impulse = Vec3(1, 0, 0);
  Contact open = contact_at(5.2, -5);
  open.gap = 1e-3;
  const ContactMemories after = match_memories(
      before, {open, contact_at(5.1, -4), contact_at(5.9, -3), contact_at(5.0, -2), contact_at(6.0, -1)},
      std::vector<Pose>{moved, moved});
  const double damage[] = {1, 1, 0, 1, 0};
  for (size_t i = 0; i < after.values.size(); ++i) EXPECT_EQ(after.of(i).joint.damage, damage[i]) << i;
  EXPECT_EQ(after.of(1).elastic_slip_A.y(), 1e-5) << "a slip per area";
  EXPECT_EQ(after.of(1).impulse.x(), 0.0) << "an impulse belongs to one point";
  EXPECT_EQ(after.of(0).elastic_slip_A.y(), 0.0) << "an open point has no shear";
}

}  // namespace
}  // namespace cupola::contact_memory_test
