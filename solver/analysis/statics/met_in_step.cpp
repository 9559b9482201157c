#include "solver/analysis/statics/met_in_step.hpp"

#include <optional>
#include <set>
#include <utility>

#include "solver/collision/face_clipping.hpp"
#include "solver/collision/separating_axis.hpp"

namespace cupola {
namespace {

Eigen::Isometry3d isometry(const Pose& pose) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = pose.q_WB.toRotationMatrix();
  X.translation() = pose.p_WB;
  return X;
}

/// The pairs of parts that have contacts.
class KnownParts {
 public:
  explicit KnownParts(const ContactSet& contacts) : contacts_(contacts) {}
  bool contains(int part_a, int part_b) {
    if (!parts_) {
      parts_.emplace();
      for (const Contact& contact : contacts_.points) parts_->insert({contact.id.part_a, contact.id.part_b});
    }
    return parts_->contains({part_a, part_b});
  }

 private:
  const ContactSet& contacts_;
  std::optional<std::set<std::pair<int, int>>> parts_;  // most steps need none
};

}  // namespace

std::vector<double> ways(const CollisionModel& shapes, std::span<const Pose> from, std::span<const Pose> to) {
  std::vector<double> way(from.size());
  for (size_t b = 0; b < way.size(); ++b) way[b] = motion_bound(from[b], to[b], shapes.block_radius[b]);
  return way;
}

std::vector<MetBlocks> met_unseen(const ContactDetector& detector, const ContactSet& known,
                                  std::span<const Pose> from, std::span<const Pose> to) {
  const CollisionModel& shapes = detector.model();
  const NarrowPhaseOptions& narrow = detector.narrow_phase();
  // What sinks into its bed overlaps the sides of its neighbours by less than that.
  const double least = narrow.min_width;
  KnownParts known_parts(known);
  const auto meet = [&](int a, int b, const Eigen::Isometry3d& before, const Eigen::Isometry3d& after) {
    if (separated_by_face(shapes, a, b, after, -least)) return false;
    const double gap = separation(shapes, a, b, after, narrow);
    return gap < -least && gap < separation(shapes, a, b, before, narrow) - least &&
           !known_parts.contains(a, b);
  };
  std::vector<MetBlocks> met;
  for (const TrackedPair& pair : detector.memory().pairs) {
    const Pose start = relative_pose(from[pair.a], from[pair.b]), end = relative_pose(to[pair.a], to[pair.b]);
    if (relative_motion(start, end, shapes.block_radius[pair.a], shapes.block_radius[pair.b]) <= least)
      continue;
    const Eigen::Isometry3d before = isometry(start), after = isometry(end);
    bool any = false;
    for (int a = shapes.part_start[pair.a]; a < shapes.part_start[pair.a + 1]; ++a)
      for (int b = shapes.part_start[pair.b]; b < shapes.part_start[pair.b + 1]; ++b)
        any = any || meet(a, b, before, after);
    if (any) met.push_back({pair.a, pair.b});
  }
  return met;
}

}  // namespace cupola
