#include "solver/collision/tracked_pairs.hpp"

#include <algorithm>
#include <utility>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Appends patches of one set to another, in their order, with their contacts.
class PatchMover {
 public:
  PatchMover(AnchoredContacts* from, AnchoredContacts* to) : from_(*from), to_(*to) {}

  bool at_end() const { return patch_ == from_.set.patches.size(); }
  std::pair<int, int> blocks() const {
    return {from_.set.patches[patch_].block_a, from_.set.patches[patch_].block_b};
  }
  void move() {
    const int index = static_cast<int>(to_.set.patches.size());
    for (; next_is_on_patch(); ++point_) {
      to_.set.points.push_back(from_.set.points[point_]);
      to_.set.points.back().patch = index;
      to_.anchors.push_back(from_.anchors[point_]);
    }
    to_.set.patches.push_back(std::move(from_.set.patches[patch_]));
    to_.patch_polygons.push_back(std::move(from_.patch_polygons[patch_]));
    ++patch_;
  }
  void skip() {
    while (next_is_on_patch()) ++point_;
    ++patch_;
  }

 private:
  bool next_is_on_patch() const {
    return point_ < from_.set.points.size() && from_.set.points[point_].patch == static_cast<int>(patch_);
  }

  AnchoredContacts& from_;
  AnchoredContacts& to_;
  std::size_t patch_ = 0, point_ = 0;
};

}  // namespace

Pose relative_pose(const Pose& a, const Pose& b) {
  const Eigen::Quaterniond q_AW = a.q_WB.conjugate();
  return {q_AW * Vec3(b.p_WB - a.p_WB), q_AW * b.q_WB};
}

double motion_bound(const Pose& from, const Pose& to, double radius) {
  return (to.p_WB - from.p_WB).norm() + radius * from.q_WB.angularDistance(to.q_WB);
}

double relative_motion(const Pose& from, const Pose& to, double radius_a, double radius_b) {
  const Eigen::Quaterniond from_inverse = from.q_WB.conjugate(), to_inverse = to.q_WB.conjugate();
  // A turn by theta moves a point at distance r by 2 r sin(theta / 2).
  const double chord = 2.0 * (from_inverse * to.q_WB).vec().norm();
  const double in_a = (to.p_WB - from.p_WB).norm() + radius_b * chord;
  const double in_b = (to_inverse * to.p_WB - from_inverse * from.p_WB).norm() + radius_a * chord;
  return std::min(in_a, in_b);
}

void take_configurations(std::span<const TrackedPair> old, std::span<TrackedPair> pairs) {
  auto before = old.begin();
  for (TrackedPair& pair : pairs) {
    while (before != old.end() && std::pair(before->a, before->b) < std::pair(pair.a, pair.b)) ++before;
    if (before != old.end() && before->a == pair.a && before->b == pair.b) pair = *before;
  }
}

void replace_contacts(std::span<const TrackedPair> pairs, AnchoredContacts fresh,
                      AnchoredContacts* contacts) {
  AnchoredContacts old = std::move(*contacts);
  *contacts = {};
  contacts->set.points.reserve(old.set.points.size() + fresh.set.points.size());
  contacts->anchors.reserve(old.set.points.size() + fresh.set.points.size());
  PatchMover kept(&old, contacts), computed(&fresh, contacts);
  for (const TrackedPair& pair : pairs) {
    const std::pair blocks(pair.a, pair.b);
    while (!kept.at_end() && kept.blocks() < blocks) kept.skip();
    for (; !kept.at_end() && kept.blocks() == blocks; pair.stale ? kept.skip() : kept.move()) {
    }
    while (!computed.at_end() && computed.blocks() == blocks) computed.move();
  }
  CUPOLA_ASSERT(computed.at_end());
}

}  // namespace cupola
