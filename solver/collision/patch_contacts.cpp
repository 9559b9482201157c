#include "solver/collision/patch_contacts.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "assembly/base/error.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

ContactAnchor anchor_of(const LiftedPoint& point, const CornerNormal& corner,
                        const Eigen::Isometry3d& pose_ab) {
  const Eigen::Isometry3d pose_ba = pose_ab.inverse(Eigen::Isometry);
  return {point.on_a, pose_ba * point.on_b, corner.normal, pose_ba.linear() * corner.normal, corner.weight_a,
          0.0};
}

/// m2, of the part of a patch whose gap, a linear function of the place, is at most `margin`.
double closed_area(const JointPatch& patch, const std::vector<Vec2>& outline, double margin) {
  std::vector<Vec2> closed;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &start = outline[i], &end = outline[(i + 1) % outline.size()];
    const double from = margin - lift_to_faces(patch, start).gap, to = margin - lift_to_faces(patch, end).gap;
    if (from >= 0.0) closed.push_back(start);
    if ((from >= 0.0) != (to >= 0.0)) closed.push_back(start + from / (from - to) * (end - start));
  }
  return polygon_area(closed);
}

/// Reduces the points from `first` on, of a patch that opens by more than `margin`, to what is closed of it.
void set_closed_share(const JointPatch& patch, const std::vector<Vec2>& outline, double margin,
                      std::size_t first, std::vector<Contact>* points) {
  const auto is_closed = [&](const Vec2& x) { return lift_to_faces(patch, x).gap <= margin; };
  if (std::ranges::all_of(outline, is_closed)) return;
  double area = 0.0;
  for (std::size_t i = first; i < points->size(); ++i) area += (*points)[i].area;
  const double share = std::min(1.0, closed_area(patch, outline, margin) / area);
  for (std::size_t i = first; i < points->size(); ++i) (*points)[i].closed_share = share;
}

/// Identifies a patch among those of two blocks.
auto patch_key(const ContactId& id) {
  return std::tuple(id.part_a, id.part_b, id.face_a, id.face_b);
}

auto block_pair(const Contact& contact) {
  return std::pair(contact.block_a, contact.block_b);
}

/// Contacts [start, end) of one patch, in the order of the set.
struct Range {
  std::size_t start = 0, end = 0;
};

/// Patches of the block pair whose contacts begin at `start`.
std::vector<Range> patches_of_pair(const std::vector<Contact>& contacts, std::size_t start) {
  std::vector<Range> patches;
  for (std::size_t i = start; i < contacts.size() && block_pair(contacts[i]) == block_pair(contacts[start]);
       ++i) {
    if (patches.empty() || contacts[i].patch != contacts[patches.back().start].patch)
      patches.push_back({i, i});
    patches.back().end = i + 1;
  }
  return patches;
}

/// Position of a patch in the axes of block a.
struct Place {
  Vec3 center = Vec3::Zero();  // m
  Vec3 normal = Vec3::Zero();  // unit
  double radius = 0.0;         // m
};

Place place_of(const AnchoredContacts& contacts, Range range) {
  Place place;
  for (std::size_t i = range.start; i < range.end; ++i) {
    place.center += contacts.anchors[i].r_a / static_cast<double>(range.end - range.start);
    place.normal += contacts.anchors[i].normal_a;
  }
  place.normal.normalize();
  for (std::size_t i = range.start; i < range.end; ++i)
    place.radius = std::max(place.radius, (contacts.anchors[i].r_a - place.center).norm());
  return place;
}

/// For each patch of a block pair, the old patch that it continues: the one with the same key, else the
/// nearest one in the same plane. A patch merged from several pairs of parts changes its key when a sliver is
/// added.
std::vector<std::optional<Range>> predecessors(const AnchoredContacts& old_contacts,
                                               std::vector<Range> old_patches,
                                               const AnchoredContacts& contacts,
                                               const std::vector<Range>& patches) {
  constexpr double kSamePlane = 0.999;  // cosine of the normals
  std::vector<std::optional<Range>> found(patches.size());
  const auto key = [](const AnchoredContacts& set, Range range) {
    return patch_key(set.set.points[range.start].id);
  };
  for (std::size_t n = 0; n < patches.size(); ++n)
    for (std::size_t k = 0; k < old_patches.size() && !found[n]; ++k) {
      if (key(contacts, patches[n]) != key(old_contacts, old_patches[k])) continue;
      found[n] = old_patches[k];
      old_patches.erase(old_patches.begin() + static_cast<std::ptrdiff_t>(k));
    }
  for (std::size_t n = 0; n < patches.size() && !old_patches.empty(); ++n) {
    if (found[n]) continue;
    const Place place = place_of(contacts, patches[n]);
    auto nearest = old_patches.end();
    double least = place.radius;
    for (auto old = old_patches.begin(); old != old_patches.end(); ++old) {
      const Place before = place_of(old_contacts, *old);
      const double distance = (before.center - place.center).norm();
      if (before.normal.dot(place.normal) < kSamePlane || distance > std::min(least, before.radius)) continue;
      nearest = old;
      least = distance;
    }
    if (nearest == old_patches.end()) continue;
    found[n] = *nearest;
    old_patches.erase(nearest);
  }
  return found;
}

/// Smallest unused number >= 0 (corner) or largest unused number <= -1 (inner point).
int free_number(bool corner, const std::set<int>& taken) {
  int number = corner ? 0 : -1;
  while (taken.contains(number)) number += corner ? 1 : -1;
  return number;
}

/// Gives the points of a patch the identities of the nearest points of the old patch. Points without a
/// partner get unused numbers and are added to `unmatched`.
void match_patch(const AnchoredContacts& old_contacts, Range old_range, Range range, AnchoredContacts* fresh,
                 std::set<ContactId>* unmatched) {
  struct Candidate {
    double distance;
    std::size_t old_index, index;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = range.start; i < range.end; ++i)
    for (std::size_t k = old_range.start; k < old_range.end; ++k)
      if ((fresh->set.points[i].id.corner < 0) == (old_contacts.set.points[k].id.corner < 0))
        candidates.push_back({(fresh->anchors[i].r_a - old_contacts.anchors[k].r_a).norm(), k, i});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& p, const Candidate& q) { return p.distance < q.distance; });
  std::set<int> taken;
  std::vector<std::optional<int>> numbers(range.end - range.start);
  for (const Candidate& c : candidates) {
    const int number = old_contacts.set.points[c.old_index].id.corner;
    if (numbers[c.index - range.start] || taken.contains(number)) continue;
    numbers[c.index - range.start] = number;
    fresh->anchors[c.index].rest_gap = old_contacts.anchors[c.old_index].rest_gap;
    taken.insert(number);
  }
  for (std::size_t i = range.start; i < range.end; ++i) {
    ContactId& id = fresh->set.points[i].id;
    const int number = numbers[i - range.start].value_or(free_number(id.corner >= 0, taken));
    taken.insert(number);
    id = old_contacts.set.points[old_range.start].id;
    id.corner = number;
    if (!numbers[i - range.start]) unmatched->insert(id);
  }
}

/// Renumbers points whose identity occurs twice, because a patch took over the key of an old patch that
/// another new patch has as well.
void make_unique(const std::vector<Range>& patches, AnchoredContacts* contacts) {
  std::set<ContactId> seen;
  for (const Range& patch : patches)
    for (std::size_t i = patch.start; i < patch.end; ++i) {
      ContactId& id = contacts->set.points[i].id;
      const int step = id.corner >= 0 ? 1 : -1;
      while (!seen.insert(id).second) id.corner += step;
    }
}

void sort_patch(Range range, AnchoredContacts* contacts) {
  const auto number = [&](std::size_t i) { return contacts->set.points[i].id.corner; };
  // Insertion sort: patches have few points, and contacts and anchors move together.
  for (std::size_t i = range.start + 1; i < range.end; ++i)
    for (std::size_t k = i; k > range.start && number(k) < number(k - 1); --k) {
      std::swap(contacts->set.points[k], contacts->set.points[k - 1]);
      std::swap(contacts->anchors[k], contacts->anchors[k - 1]);
    }
}

}  // namespace

void append(std::span<AnchoredContacts> chunks, AnchoredContacts* contacts) {
  constexpr double kOperationsPerContact = 300.0;
  const auto take = [](auto* to, auto* from) {
    to->insert(to->end(), std::make_move_iterator(from->begin()), std::make_move_iterator(from->end()));
    from->clear();
  };
  double work = 0.0;
  int patches = static_cast<int>(contacts->set.patches.size());
  for (AnchoredContacts& chunk : chunks) {
    for (Contact& contact : chunk.set.points) contact.patch += patches;
    patches += static_cast<int>(chunk.set.patches.size());
    work += kOperationsPerContact * static_cast<double>(chunk.anchors.size());
  }
  const std::array<std::function<void(AnchoredContacts*)>, 3> parts{
      [&](AnchoredContacts* chunk) { take(&contacts->set.points, &chunk->set.points); },
      [&](AnchoredContacts* chunk) { take(&contacts->anchors, &chunk->anchors); },
      [&](AnchoredContacts* chunk) {
        take(&contacts->set.patches, &chunk->set.patches);
        take(&contacts->patch_polygons, &chunk->patch_polygons);
      }};
  share_loop(work, static_cast<int>(parts.size()), [&](int part) {
    for (AnchoredContacts& chunk : chunks) parts[part](&chunk);
  });
}

void append_patch(const CollisionModel& model, const JointPatch& patch, const Eigen::Isometry3d& pose_ab,
                  double margin, double reach, const PatchSampling& sampling, double nominal_area,
                  AnchoredContacts* contacts) {
  const int block_a = model.parts[patch.part_a].block;
  const int block_b = model.parts[patch.part_b].block;
  CUPOLA_ASSERT(block_a < block_b);
  CUPOLA_ASSERT(patch.has_area() || patch.touching.size() == patch.corners.size());
  const int patch_index = static_cast<int>(contacts->set.patches.size());
  const std::size_t first = contacts->set.points.size();
  const auto append = [&](const LiftedPoint& point, const CornerNormal& normal, double area, int corner) {
    if (point.gap > margin + reach) return;
    Contact contact;
    contact.id = {patch.part_a, patch.part_b, patch.face_a, patch.face_b, corner};
    contact.block_a = block_a;
    contact.block_b = block_b;
    contact.patch = patch_index;
    contact.area = area;
    contacts->set.points.push_back(contact);
    contacts->anchors.push_back(anchor_of(point, normal, pose_ab));
  };

  Patch shape{block_a, block_b, patch.kind, patch.ring, {}, 0.0};
  std::vector<Vec3> polygon;
  if (patch.has_area()) {
    const std::vector<Vec2> outline = patch.outline();
    shape.area = polygon_area(outline);
    for (const Vec2& x : outline) polygon.push_back(lift_to_faces(patch, x).on_a);
    for (const PatchPoint& point : patch_points(outline, sampling))
      append(lift_to_faces(patch, point.position),
             point.corner < 0 ? CornerNormal{patch.normal, 0.5} : patch.corners[point.corner].normal,
             point.area, point.corner);
    set_closed_share(patch, outline, margin, first, &contacts->set.points);
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

MovedContacts moved_contacts(const ContactSet& set, const std::vector<char>& moved) {
  MovedContacts found;
  std::vector<char> needed(moved.size(), 0);
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    const Contact& contact = set.points[i];
    if (!moved[contact.block_a] && !moved[contact.block_b]) continue;
    found.contacts.push_back(static_cast<int>(i));
    needed[contact.block_a] = needed[contact.block_b] = 1;
  }
  for (std::size_t p = 0; p < set.patches.size(); ++p) {
    if (!moved[set.patches[p].block_a]) continue;
    found.patches.push_back(static_cast<int>(p));
    needed[set.patches[p].block_a] = 1;
  }
  for (std::size_t b = 0; b < needed.size(); ++b)
    if (needed[b]) found.blocks.push_back(static_cast<int>(b));
  return found;
}

void move_contacts(std::span<const Pose> poses, const MovedContacts& moved, AnchoredContacts* contacts) {
  CUPOLA_ASSERT(contacts->patch_polygons.size() == contacts->set.patches.size());
  std::vector<Mat3> R_WB(poses.size());
  for (const int b : moved.blocks) R_WB[b] = poses[b].q_WB.toRotationMatrix();
  const auto move_contact = [&](int i) {
    const ContactAnchor& anchor = contacts->anchors[i];
    Contact& contact = contacts->set.points[i];
    const int a = contact.block_a;
    const int b = contact.block_b;
    const Vec3 r_a = R_WB[a] * anchor.r_a;
    const Vec3 r_b = R_WB[b] * anchor.r_b;
    contact.point_a = poses[a].p_WB + r_a;
    contact.point_b = poses[b].p_WB + r_b;
    contact.normal = (anchor.weight_a * (R_WB[a] * anchor.normal_a) +
                      (1.0 - anchor.weight_a) * (R_WB[b] * anchor.normal_b))
                         .normalized();
    // Subtracting the centroids first keeps the precision that the points lose far from the origin.
    contact.gap = contact.normal.dot((poses[b].p_WB - poses[a].p_WB) + (r_b - r_a)) - anchor.rest_gap;
  };
  constexpr double kOperationsPerContact = 150.0;
  const int count = static_cast<int>(moved.contacts.size());
  share_sums(kOperationsPerContact * count, count, [&](int first, int last) {
    for (int k = first; k < last; ++k) move_contact(moved.contacts[k]);
  });
  for (const int p : moved.patches) {
    Patch& patch = contacts->set.patches[p];
    patch.polygon.clear();
    for (const Vec3& r_a : contacts->patch_polygons[p])
      patch.polygon.push_back(poses[patch.block_a].p_WB + R_WB[patch.block_a] * r_a);
  }
}

std::set<ContactId> transfer_identities(const AnchoredContacts& old_contacts, AnchoredContacts* contacts) {
  CUPOLA_ASSERT(old_contacts.anchors.size() == old_contacts.set.points.size());
  CUPOLA_ASSERT(contacts->anchors.size() == contacts->set.points.size());
  std::set<ContactId> lateral;
  const std::vector<Contact>& old_set = old_contacts.set.points;
  std::size_t old_start = 0;
  for (std::size_t start = 0; start < contacts->set.points.size();) {
    const std::vector<Range> patches = patches_of_pair(contacts->set.points, start);
    const auto pair = block_pair(contacts->set.points[start]);
    while (old_start < old_set.size() && block_pair(old_set[old_start]) < pair) ++old_start;
    std::vector<Range> old_patches;
    if (old_start < old_set.size() && block_pair(old_set[old_start]) == pair)
      old_patches = patches_of_pair(old_set, old_start);
    const std::vector<std::optional<Range>> before =
        predecessors(old_contacts, old_patches, *contacts, patches);
    std::size_t continued = 0;
    for (std::size_t n = 0; n < patches.size(); ++n) {
      if (!before[n]) continue;
      match_patch(old_contacts, *before[n], patches[n], contacts, &lateral);
      ++continued;
    }
    make_unique(patches, contacts);
    for (std::size_t n = 0; n < patches.size() && continued == old_patches.size(); ++n)
      for (std::size_t i = patches[n].start; i < patches[n].end && !before[n]; ++i)
        lateral.insert(contacts->set.points[i].id);
    for (const Range& patch : patches) sort_patch(patch, contacts);
    start = patches.back().end;
  }
  return lateral;
}

void update_rest_gaps(const std::set<ContactId>& lateral, AnchoredContacts* contacts) {
  const auto set_rest_gap = [&](std::size_t i, double rest_gap) {
    double& rest = contacts->anchors[i].rest_gap;
    contacts->set.points[i].gap += rest - rest_gap;
    rest = rest_gap;
  };
  const auto geometric_gap = [&](std::size_t i) {
    return contacts->set.points[i].gap + contacts->anchors[i].rest_gap;
  };
  for (std::size_t i = 0; i < contacts->anchors.size(); ++i) {
    const bool starts = lateral.contains(contacts->set.points[i].id);
    if (starts || geometric_gap(i) > contacts->anchors[i].rest_gap)
      set_rest_gap(i, std::min(0.0, geometric_gap(i)));
  }
}

}  // namespace cupola
