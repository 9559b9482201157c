#include "generators/stereotomy/meetings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/stereotomy/cut_planes.hpp"
#include "generators/stereotomy/separation.hpp"

namespace cupola {
namespace {

/// Looks for faces that two members share in a plane.
class PlaneOfTwo {
 public:
  PlaneOfTwo(std::span<const MemberStart> starts, const Plane& plane, Assembly* assembly)
      : starts_(starts), plane_(plane), assembly_(assembly) {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : assembly->vertices) box.extend(v);
    rounding_ = 1e-9 * box.diagonal().norm();
  }

  /// Faces of stones of a storey in the plane, with their outward normal along its normal or against it.
  std::vector<int> faces(size_t storey, bool along) const {
    std::vector<int> found;
    const double sign = along ? 1.0 : -1.0;
    for (size_t p = starts_[storey].part; p < starts_[storey + 1].part; ++p) {
      const Part& part = assembly_->parts[p];
      if (assembly_->blocks[part.block].fixed) continue;
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
        const std::vector<Vec3> points = face_points(*assembly_, f);
        const bool in_plane = std::ranges::all_of(points, [&](const Vec3& corner) {
          return std::abs(plane_.normal.dot(corner) - plane_.offset) < rounding_;
        });
        if (in_plane && sign * polygon_plane(points).normal.dot(plane_.normal) > 0.0) found.push_back(f);
      }
    }
    return found;
  }

  bool share_a_patch(const std::vector<int>& one, const std::vector<int>& other) const {
    return std::ranges::any_of(one, [&](int f) {
      const std::vector<Vec3> points = face_points(*assembly_, f);
      return std::ranges::any_of(other, [&](int g) {
        return overlap_width(points, face_points(*assembly_, g), plane_.normal) > rounding_;
      });
    });
  }

 private:
  std::span<const MemberStart> starts_;
  Plane plane_;
  Assembly* assembly_;
  double rounding_ = 0.0;  // m
};

Plane in_world(const Plane& plane, const Storey& storey) {
  return moved({plane}, storey.placement).front();
}

/// How far the stones behind faces in a plane are bedded on it, from 0 to 1: the squares of the cosines of its
/// normal with the beds of each, by area. Stones without beds do not count.
double along_beds(const std::vector<int>& faces, const Vec3& normal, const Assembly& assembly) {
  double sum = 0.0, area = 0.0;
  for (const int f : faces) {
    const Part& part = *std::prev(std::ranges::upper_bound(assembly.parts, f, {}, &Part::face_start));
    std::optional<double> nearest;
    for (int g = part.face_start; g < part.face_start + part.num_faces; ++g) {
      if (assembly.face_kinds[g] != FaceKind::bed && assembly.face_kinds[g] != FaceKind::top) continue;
      const double cosine = polygon_plane(face_points(assembly, g)).normal.dot(normal);
      nearest = std::max(nearest.value_or(0.0), cosine * cosine);
    }
    if (!nearest) continue;
    const double own = polygon_area(face_points(assembly, f));
    sum += own * *nearest;
    area += own;
  }
  return area > 0.0 ? sum / area : 0.0;
}

void join_mitre(std::span<const Storey> storeys, std::span<const MemberStart> starts, size_t i, size_t k,
                Assembly* assembly) {
  const Cut& cut = storeys[i].cuts[k];
  const auto other =
      static_cast<size_t>(std::ranges::find(storeys, cut.member, &Storey::name) - storeys.begin());
  const Vec3 lost = cut.normal.normalized();
  const Plane plane = in_world({lost, lost.dot(cut.point)}, storeys[i]);
  const PlaneOfTwo both(starts, plane, assembly);
  const std::vector<int> own = both.faces(i, true), beyond = both.faces(other, false);
  if (!both.share_a_patch(own, beyond))
    throw InputError(
        fmt::format("{}.cuts[{}].as = mitre: no stone of {} meets one of {} on the plane, which both must "
                    "reach: make them longer, or move the plane",
                    storeys[i].key, k, storeys[i].name, cut.member));
  constexpr double kDiagonal = 0.5 + 1e-9;  // cos2 of 45 degrees, and rounding
  const bool is_bed = std::max(along_beds(own, plane.normal, *assembly),
                               along_beds(beyond, plane.normal, *assembly)) > kDiagonal;
  for (const std::vector<int>* faces : {&own, &beyond})
    for (const int f : *faces) assembly->face_kinds[f] = is_bed ? FaceKind::bed : FaceKind::head;
}

}  // namespace

void pair_mitres(std::vector<Storey>* storeys) {
  std::map<std::string, std::vector<std::string>> copies;  // names, by the key of their member
  for (const Storey& storey : *storeys) copies[storey.key].push_back(storey.name);
  for (Storey& storey : *storeys)
    for (size_t i = 0; i < storey.cuts.size(); ++i) {
      Cut& cut = storey.cuts[i];
      const auto other = std::ranges::find(*storeys, cut.member, &Storey::name);
      if (cut.as != Cut::As::mitre || other == storeys->end()) continue;
      const std::vector<std::string>&own = copies[storey.key], &names = copies[other->key];
      if (own.size() == 1 || names.size() == 1) continue;
      const auto copy = static_cast<size_t>(std::ranges::find(own, storey.name) - own.begin());
      if (&own != &names && cut.member == names.front() && copy < names.size()) {
        cut.member = names[copy];
        continue;
      }
      throw InputError(fmt::format(
          "{}.cuts[{}].member = {}: each copy is mitred with the copy of another member that has its number, "
          "which {} does not have: name a member with as many copies, or list these members one by one",
          storey.key, i, cut.member, storey.name));
    }
}

void check_meetings(std::span<const Storey> storeys, std::span<const MemberStart> starts,
                    Assembly* assembly) {
  for (size_t i = 0; i < storeys.size(); ++i) {
    for (size_t k = 0; k < storeys[i].cuts.size(); ++k)
      if (storeys[i].cuts[k].as == Cut::As::mitre) join_mitre(storeys, starts, i, k, assembly);
    if (storeys[i].beside.empty()) continue;
    const auto other =
        static_cast<size_t>(std::ranges::find(storeys, storeys[i].beside, &Storey::name) - storeys.begin());
    const PlaneOfTwo both(starts, in_world(storeys[i].limits.front(), storeys[i]), assembly);
    if (!both.share_a_patch(both.faces(i, true), both.faces(other, false)))
      throw InputError(fmt::format(
          "{}.beside.member = {}: nothing of {} touches {} in their common plane: move it by `at`, "
          "or remove `beside`",
          storeys[i].key, storeys[i].beside, storeys[i].name, storeys[i].beside));
  }
}

}  // namespace cupola
