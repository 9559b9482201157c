#include "solver/collision/contact_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <tuple>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/number_text.hpp"
#include "assembly/model/block_distance.hpp"
#include "assembly/model/joint_rule.hpp"
#include "assembly/model/polygon_parts.hpp"

namespace cupola {
namespace {

constexpr std::string_view kHeader = "block_a,block_b,joint,x,y,z,nx,ny,nz,gap_m,area_m2";
constexpr std::size_t kColumns = 11;

struct Row {
  int block_a = 0, block_b = 0, joint = 0;
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();
  double gap = 0.0, area = 0.0;
};

std::array<double, kColumns> read_numbers(const std::string& line, const FileLocation& where) {
  std::array<double, kColumns> values{};
  std::istringstream stream(line);
  std::string cell;
  std::size_t count = 0;
  while (std::getline(stream, cell, ',')) {
    if (count == kColumns)
      throw InputError(where, fmt::format("more than {} columns; the columns are {}", kColumns, kHeader));
    const std::string broken_rule = read_number(cell, &values[count]);
    if (!broken_rule.empty())
      throw InputError(where, fmt::format("column {}: '{}': {}", count + 1, cell, broken_rule));
    ++count;
  }
  if (count < kColumns)
    throw InputError(where, fmt::format("{} of {} columns; the columns are {}", count, kColumns, kHeader));
  return values;
}

/// An integer from `low` to `high`; `what` begins the message.
int integer_of(double value, int low, int high, const char* what, const FileLocation& where) {
  if (!(value >= low && value <= high) || value != std::floor(value))
    throw InputError(where, fmt::format("{} {}: must be an integer from {} to {}", what, value, low, high));
  return static_cast<int>(value);
}

/// How many faces of a block that a point lies on, within the margin, look along n, and how many against it.
struct FacesAtPoint {
  int along = 0, against = 0;
};
FacesAtPoint faces_at(const Assembly& assembly, int block, const Vec3& point, const Vec3& n,
                      const JointRule& rule) {
  FacesAtPoint count;
  for (const Part& part : parts_of_block(assembly, block)) {
    if (distance_from_part(assembly, part, point) > rule.margin) continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const Plane plane = polygon_plane(face_points(assembly, f));
      if (assembly.face_kinds[f] == FaceKind::internal ||
          plane.normal.dot(point) - plane.offset < -rule.margin)
        continue;
      count.along += plane.normal.dot(n) >= std::cos(rule.max_angle) ? 1 : 0;
      count.against += plane.normal.dot(n) <= -std::cos(rule.max_angle) ? 1 : 0;
    }
  }
  return count;
}

/// Throws InputError if the gap is beyond the margin of detected contacts, the point is far from a block, its
/// area is larger than the block's surface, or the normal points from b to a.
void check_place(const Row& row, const Assembly& assembly, const JointRule& rule, const FileLocation& where) {
  // Of the size of a block: the other program may have curved faces where ours are planes.
  constexpr double kFarthest = 0.1;
  if (std::abs(row.gap) > rule.margin)
    throw InputError(where, fmt::format("gap_m = {:g}: blocks touch within contact.margin = {:.3g} m",
                                        row.gap, rule.margin));
  const Vec3 half_gap = 0.5 * row.gap * row.normal;
  for (const auto& [block, on_block] :
       {std::pair(row.block_a, Vec3(row.point - half_gap)), {row.block_b, row.point + half_gap}}) {
    const double outside = distance_from_block(assembly, block, on_block);
    double surface = 0.0;
    for (const PlanePolygon& face : faces_of_block(assembly, block)) surface += polygon_area(face.corners);
    if (row.area > surface)
      throw InputError(where, fmt::format("area_m2 = {:g}: the faces of block {} have {:g} m2 in all",
                                          row.area, block, surface));
    if (outside > kFarthest * std::cbrt(assembly.blocks[block].volume))
      throw InputError(where, fmt::format("the point lies {:.3g} m beyond the faces of block {}, more than a "
                                          "tenth of the size of the block",
                                          outside, block));
  }
  const FacesAtPoint a = faces_at(assembly, row.block_a, row.point - half_gap, row.normal, rule),
                     b = faces_at(assembly, row.block_b, row.point + half_gap, -row.normal, rule);
  if (a.along + b.along == 0 && a.against + b.against > 0)
    throw InputError(
        where, "nx, ny, nz point from block_b to block_a: must be the direction from block_a to block_b");
}

Row read_row(const std::string& line, const Assembly& assembly, const JointRule& rule,
             const FileLocation& where) {
  const auto v = read_numbers(line, where);
  Row row;
  const int last = static_cast<int>(assembly.blocks.size()) - 1;
  row.block_a = integer_of(v[0], 0, last, "block", where);
  row.block_b = integer_of(v[1], 0, last, "block", where);
  row.joint =
      integer_of(v[2], std::numeric_limits<int>::min(), std::numeric_limits<int>::max(), "joint", where);
  row.point = Vec3(v[3], v[4], v[5]);
  row.normal = Vec3(v[6], v[7], v[8]);
  row.gap = v[9];
  row.area = v[10];
  if (row.block_a == row.block_b)
    throw InputError(where, fmt::format("block_a and block_b are both {}", row.block_a));
  if (!(row.normal.stableNorm() > 0.0))
    throw InputError(where, "nx, ny, nz are all zero: must be the direction from block_a to block_b");
  if (!(row.area > 0.0)) throw InputError(where, fmt::format("area_m2 = {}: must be > 0", row.area));
  row.normal.stableNormalize();
  if (row.block_a > row.block_b) {
    std::swap(row.block_a, row.block_b);
    row.normal = -row.normal;
  }
  check_place(row, assembly, rule, where);
  return row;
}

Patch make_patch(const Row& row, const Assembly& assembly) {
  const Block& a = assembly.blocks[row.block_a];
  const Block& b = assembly.blocks[row.block_b];
  Patch patch{row.block_a, row.block_b, JointKind::other, std::max(a.ring, b.ring), {}, 0.0};
  if (a.fixed || b.fixed) {
    patch.kind = JointKind::base;
  } else if (assembly.num_rings > 0) {
    patch.kind = a.ring == b.ring ? JointKind::head : JointKind::bed;
  }
  return patch;
}

void append_row(const Row& row, const Assembly& assembly, bool new_patch, AnchoredContacts* contacts) {
  const Vec3& centroid_a = assembly.blocks[row.block_a].centroid;
  const Vec3& centroid_b = assembly.blocks[row.block_b].centroid;
  if (new_patch) {
    contacts->set.patches.push_back(make_patch(row, assembly));
    contacts->patch_polygons.emplace_back();
  }
  Contact contact;
  contact.block_a = row.block_a;
  contact.block_b = row.block_b;
  contact.patch = static_cast<int>(contacts->set.patches.size()) - 1;
  // The file has no parts and faces: the number of the joint identifies the patch.
  contact.id.part_a = contact.id.part_b = contact.patch;
  contact.id.corner = new_patch ? 0 : contacts->set.points.back().id.corner + 1;
  contact.area = row.area;
  const Vec3 half_gap = 0.5 * row.gap * row.normal;
  contacts->set.patches.back().area += row.area;
  contacts->patch_polygons.back().push_back(row.point - half_gap - centroid_a);
  contacts->set.points.push_back(contact);
  contacts->anchors.push_back(
      {row.point - half_gap - centroid_a, row.point + half_gap - centroid_b, row.normal, row.normal, 0.5});
}

}  // namespace

AnchoredContacts read_contacts(const std::string& path, const Assembly& assembly, double margin) {
  const JointRule rule = joint_rule(smallest_block_size(assembly), margin);
  std::istringstream stream(read_text(path));
  std::vector<Row> rows;
  FileLocation where{path, 0, 1};
  for (std::string line; std::getline(stream, line);) {
    ++where.line;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (where.line == 1) {
      if (line != kHeader) throw InputError(where, fmt::format("the first line must be {}", kHeader));
    } else if (!line.empty()) {
      rows.push_back(read_row(line, assembly, rule, where));
    }
  }
  if (rows.empty()) throw InputError(where, "contains no contact: add a row per contact point");
  const auto joint = [](const Row& row) { return std::tuple(row.block_a, row.block_b, row.joint); };
  std::stable_sort(rows.begin(), rows.end(), [&](const Row& p, const Row& q) { return joint(p) < joint(q); });
  AnchoredContacts contacts;
  for (std::size_t i = 0; i < rows.size(); ++i)
    append_row(rows[i], assembly, i == 0 || joint(rows[i]) != joint(rows[i - 1]), &contacts);
  return contacts;
}

}  // namespace cupola
