#include "solver/collision/patch_contacts.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

namespace cupola {
namespace {

ContactAnchor anchor_of(const LiftedPoint& point, const CornerNormal& corner,
                        const Eigen::Isometry3d& pose_ab) {
  const Eigen::Isometry3d pose_ba = pose_ab.inverse(Eigen::Isometry);
  return {point.on_a, pose_ba * point.on_b, corner.normal, pose_ba.linear() * corner.normal, corner.weight_a};
}

/// What orders patches: block pair, part pair, face pair.
auto patch_name(const Contact& contact) {
  const ContactId& id = contact.id;
  return std::tuple(contact.block_a, contact.block_b, id.part_a, id.part_b, id.face_a, id.face_b);
}

/// Contacts [start, end) of one patch, in the order of the set.
struct Range {
  std::size_t start = 0, end = 0;
};

Range patch_range(const std::vector<Contact>& contacts, std::size_t start) {
  std::size_t end = start;
  while (end < contacts.size() && patch_name(contacts[end]) == patch_name(contacts[start])) ++end;
  return {start, end};
}

/// Smallest number >= 0 (corner) or largest <= -1 (inner point) that is not taken yet.
int free_number(bool corner, const std::set<int>& taken) {
  int number = corner ? 0 : -1;
  while (taken.contains(number)) number += corner ? 1 : -1;
  return number;
}

void match_patch(const AnchoredContacts& old_contacts, Range old_range, Range range,
                 AnchoredContacts* fresh) {
  struct Candidate {
    double distance;
    std::size_t old_index, index;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = range.start; i < range.end; ++i)
    for (std::size_t k = old_range.start; k < old_range.end; ++k)
      if ((fresh->set.contacts[i].id.corner < 0) == (old_contacts.set.contacts[k].id.corner < 0))
        candidates.push_back({(fresh->anchors[i].r_a - old_contacts.anchors[k].r_a).norm(), k, i});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& p, const Candidate& q) { return p.distance < q.distance; });
  std::set<int> taken;
  std::vector<std::optional<int>> numbers(range.end - range.start);
  for (const Candidate& c : candidates) {
    const int number = old_contacts.set.contacts[c.old_index].id.corner;
    if (numbers[c.index - range.start] || taken.contains(number)) continue;
    numbers[c.index - range.start] = number;
    taken.insert(number);
  }
  for (std::size_t i = range.start; i < range.end; ++i) {
    int& corner = fresh->set.contacts[i].id.corner;
    corner = numbers[i - range.start].value_or(free_number(corner >= 0, taken));
    taken.insert(corner);
  }
}

void sort_patch(Range range, AnchoredContacts* contacts) {
  const auto number = [&](std::size_t i) { return contacts->set.contacts[i].id.corner; };
  // Patches have few points: insertion keeps contacts and anchors side by side without copies.
  for (std::size_t i = range.start + 1; i < range.end; ++i)
    for (std::size_t k = i; k > range.start && number(k) < number(k - 1); --k) {
      std::swap(contacts->set.contacts[k], contacts->set.contacts[k - 1]);
      std::swap(contacts->anchors[k], contacts->anchors[k - 1]);
    }
}

}  // namespace

void append_patch(const CollisionModel& model, const JointPatch& patch, const Eigen::Isometry3d& pose_ab,
                  double margin, PatchPoints points, double nominal_area, AnchoredContacts* contacts) {
  const int block_a = model.parts[patch.part_a].block;
  const int block_b = model.parts[patch.part_b].block;
  const int patch_index = static_cast<int>(contacts->set.patches.size());
  const auto append = [&](const LiftedPoint& point, const CornerNormal& normal, double area, int corner) {
    if (point.gap > margin) return;
    Contact contact;
    contact.id = {patch.part_a, patch.part_b, patch.face_a, patch.face_b, corner};
    contact.block_a = block_a;
    contact.block_b = block_b;
    contact.patch = patch_index;
    contact.area = area;
    contacts->set.contacts.push_back(contact);
    contacts->anchors.push_back(anchor_of(point, normal, pose_ab));
  };

  Patch shape{block_a, block_b, patch.kind, patch.ring, {}, 0.0};
  std::vector<Vec3> polygon;
  if (patch.has_area()) {
    const std::vector<Vec2> outline = patch.outline();
    shape.area = polygon_area(outline);
    for (const Vec2& x : outline) polygon.push_back(lift_to_faces(patch, x).on_a);
    for (const PatchPoint& point : patch_points(outline, points))
      append(lift_to_faces(patch, point.position),
             point.corner < 0 ? CornerNormal{patch.normal, 0.5} : patch.corners[point.corner].normal,
             point.area, point.corner);
  } else {
    const double area = patch.point_area > 0.0 ? patch.point_area : nominal_area;
    shape.area = patch.point_area * static_cast<double>(patch.corners.size());
    for (std::size_t i = 0; i < patch.corners.size(); ++i) {
      polygon.push_back(patch.touching[i].on_a);
      append(patch.touching[i], patch.corners[i].normal, area, static_cast<int>(i));
    }
  }
  contacts->set.patches.push_back(shape);
  contacts->patch_polygons.push_back(std::move(polygon));
}

void move_contacts(std::span<const Pose> poses, AnchoredContacts* contacts) {
  std::vector<Mat3> R_WB;
  R_WB.reserve(poses.size());
  for (const Pose& pose : poses) R_WB.push_back(pose.q_WB.toRotationMatrix());
  for (std::size_t i = 0; i < contacts->anchors.size(); ++i) {
    const ContactAnchor& anchor = contacts->anchors[i];
    Contact& contact = contacts->set.contacts[i];
    const int a = contact.block_a;
    const int b = contact.block_b;
    const Vec3 r_a = R_WB[a] * anchor.r_a;
    const Vec3 r_b = R_WB[b] * anchor.r_b;
    contact.point_a = poses[a].p_WB + r_a;
    contact.point_b = poses[b].p_WB + r_b;
    contact.normal = (anchor.weight_a * (R_WB[a] * anchor.normal_a) +
                      (1.0 - anchor.weight_a) * (R_WB[b] * anchor.normal_b))
                         .normalized();
    // The centroids are subtracted first: far from the origin the points themselves have lost digits.
    contact.gap = contact.normal.dot((poses[b].p_WB - poses[a].p_WB) + (r_b - r_a));
  }
  for (std::size_t p = 0; p < contacts->patch_polygons.size(); ++p) {
    Patch& patch = contacts->set.patches[p];
    patch.polygon.clear();
    for (const Vec3& r_a : contacts->patch_polygons[p])
      patch.polygon.push_back(poses[patch.block_a].p_WB + R_WB[patch.block_a] * r_a);
  }
}

void keep_identities(const AnchoredContacts& old_contacts, AnchoredContacts* contacts) {
  const std::vector<Contact>& old_set = old_contacts.set.contacts;
  std::size_t old_start = 0;
  for (std::size_t start = 0; start < contacts->set.contacts.size();) {
    const Range range = patch_range(contacts->set.contacts, start);
    const Contact& first = contacts->set.contacts[start];
    while (old_start < old_set.size() && patch_name(old_set[old_start]) < patch_name(first)) ++old_start;
    if (old_start < old_set.size() && patch_name(old_set[old_start]) == patch_name(first))
      match_patch(old_contacts, patch_range(old_set, old_start), range, contacts);
    sort_patch(range, contacts);
    start = range.end;
  }
}

}  // namespace cupola
