#include "generators/importer/import.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/model/block_distance.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/joint_rule.hpp"
#include "assembly/model/polygon_parts.hpp"
#include "generators/decomposition/decompose.hpp"
#include "generators/importer/import_supports.hpp"
#include "generators/importer/readers.hpp"
#include "generators/importer/snap_facets.hpp"
#include "generators/importer/source_files.hpp"
#include "generators/importer/surfaces.hpp"

namespace cupola {
namespace {

constexpr double kSliver = 1e-3;  // thickness over size of a part

/// Measures the model. Throws InputError if it has the size of no structure and the case does not state the
/// unit.
void measure_extents(const ImportedBlocks& source, const std::vector<RawBlock>& blocks,
                     ImportReport* report) {
  constexpr double kSmallest = 0.05, kLargest = 1e3;  // m
  Eigen::AlignedBox3d box;
  for (const RawBlock& block : blocks) {
    for (const Vec3& v : block.mesh.vertices) box.extend(v);
    for (const auto& part : block.point_parts)
      for (const Vec3& v : part) box.extend(v);
  }
  report->low = box.min();
  report->high = box.max();
  const double size = box.sizes().maxCoeff();
  if (source.metres_per_unit || (size >= kSmallest && size <= kLargest)) return;
  throw InputError(
      FileLocation{source.path},
      fmt::format("the model is {:.3g} m large{}: set geometry.import.metres_per_unit, 1 if these are metres",
                  size, size > kLargest ? "; is it drawn in millimetres (metres_per_unit: 0.001)?" : ""));
}

bool is_sliver(const ConvexPolyhedron& part) {
  double size = 0.0, largest_face = 0.0;
  for (const Vec3& v : part.vertices) size = std::max(size, (v - part.vertices.front()).norm());
  for (const auto& face : part.faces) {
    std::vector<Vec3> corners;
    for (int v : face) corners.push_back(part.vertices[v]);
    largest_face = std::max(largest_face, polygon_area(corners));
  }
  return polyhedron_volume(part) < kSliver * size * largest_face;
}

void append_part(const ConvexPolyhedron& solid, const std::vector<bool>& internal, int block,
                 Assembly* assembly) {
  Part part;
  part.block = block;
  part.face_start = assembly->num_faces();
  assembly->parts.push_back(part);
  const int first = static_cast<int>(assembly->vertices.size());
  assembly->vertices.insert(assembly->vertices.end(), solid.vertices.begin(), solid.vertices.end());
  for (size_t f = 0; f < solid.faces.size(); ++f) {
    std::vector<int> ids;
    for (int v : solid.faces[f]) ids.push_back(first + v);
    assembly->add_face(ids, internal[f] ? FaceKind::internal : FaceKind::free);
  }
}

void append_blocks(const std::vector<RawBlock>& raw, const Surfaces& surfaces,
                   const DecompositionOptions& options, double density, Assembly* assembly,
                   ImportReport* report) {
  for (size_t m = 0; m < surfaces.meshes.size(); ++m) {
    const int b = surfaces.block[m];
    if (m == 0 || surfaces.block[m - 1] != b) {
      Block block;
      block.name = raw[b].name;
      block.kind = BlockKind::imported;
      block.density = raw[b].density.value_or(density);
      assembly->blocks.push_back(block);
      report->origins.push_back({raw[b].name, raw[b].where});
      report->parts.push_back(0);
      report->course_numbers.push_back(raw[b].course.value_or(kNoCourse));
    }
    const Decomposition pieces = decompose(surfaces.meshes[m], raw[b].name, options);
    using enum Decomposition::Method;
    ++(pieces.method == already_convex ? report->already_convex
       : pieces.method == planes       ? report->by_planes
       : pieces.method == prism        ? report->as_prisms
                                       : report->by_nef);
    report->largest_volume_error =
        std::max(report->largest_volume_error, std::abs(pieces.volume_error) / pieces.volume);
    report->parts.back() += static_cast<int>(pieces.parts.size());
    for (size_t p = 0; p < pieces.parts.size(); ++p) {
      append_part(pieces.parts[p], pieces.internal[p], b, assembly);
      report->sliver_parts += is_sliver(pieces.parts[p]) ? 1 : 0;
    }
  }
}

/// Compares the volumes of the blocks, which are those of their parts, with those of their drawings.
void compare_volumes(const std::vector<double>& drawn, const Assembly& assembly, ImportReport* report) {
  for (size_t b = 0; b < drawn.size(); ++b) {
    const double volume = assembly.blocks[b].volume;
    report->drawn_volume += drawn[b];
    report->volume_of_parts += volume;
    const double change = volume / drawn[b] - 1.0;
    if (std::abs(change) <= std::abs(report->most_changed)) continue;
    report->most_changed = change;
    report->most_changed_block = static_cast<int>(b);
  }
}

/// m, mean size of the blocks if it is that of no stone or brick and the case does not state the unit; else
/// 0.
double unusual_size(const ImportedBlocks& source, const ImportReport& report) {
  constexpr double kSmallest = 0.02, kLargest = 10.0;
  const double size = std::cbrt(report.volume_of_parts / static_cast<double>(report.origins.size()));
  return source.metres_per_unit || (size >= kSmallest && size <= kLargest) ? 0.0 : size;
}

/// The warning of free blocks that are drawn as several solids, as all stones in one object are; empty: none.
std::string text_of_solids(const std::vector<int>& solids, const Assembly& assembly) {
  std::vector<int> several;
  int count = 0;
  for (int b = 0; b < static_cast<int>(solids.size()); ++b)
    if (solids[b] > 1 && !assembly.blocks[b].fixed) {
      several.push_back(b);
      count += solids[b];
    }
  if (several.empty()) return {};
  return fmt::format(
      "{} {}: {} separate solids move as {}; unless these are joined, draw each as a block of its own",
      several.size() == 1 ? "block" : "blocks", block_labels(assembly, several), count,
      counted(several.size(), "rigid stone"));
}

/// Throws InputError for a tie of no direction, and for an end in the air.
void check_tie(const BuiltTie& tie, const RawTie& row, const Assembly& assembly) {
  constexpr double kFarthest = 0.1;  // of the size of the block, as for forces at points
  if (tie.block_a == tie.block_b)
    throw InputError(row.where,
                     fmt::format("both ends are on block '{}'; a tie connects two blocks", row.block_a));
  if (tie.point_a == tie.point_b || tie.length == 0.0)
    throw InputError(row.where, "the length is 0: a tie has two ends apart, and a length at rest > 0");
  for (const auto& [block, name, point] :
       {std::tuple(tie.block_a, row.block_a, tie.point_a), {tie.block_b, row.block_b, tie.point_b}}) {
    const double outside = distance_from_block(assembly, block, point);
    if (outside > kFarthest * std::cbrt(assembly.blocks[block].volume))
      throw InputError(row.where,
                       fmt::format("the end at ({:g}, {:g}, {:g}) m lies {:.3g} m beyond the faces of its "
                                   "block '{}'; correct the point, or the block",
                                   point.x(), point.y(), point.z(), outside, name));
  }
}

std::vector<BuiltTie> read_ties(const ImportedBlocks& source, const std::vector<RawBlock>& raw,
                                const Assembly& assembly) {
  std::vector<RawTie> rows;
  if (!source.springs.empty()) rows = read_springs(source.springs);
  if (!source.rods.empty())
    for (RawTie& rod : read_rods(source.rods)) rows.push_back(std::move(rod));
  std::map<std::string, int> block_of;
  for (size_t b = 0; b < raw.size(); ++b) block_of[raw[b].name] = static_cast<int>(b);
  std::vector<BuiltTie> ties;
  for (const RawTie& row : rows) {
    for (const std::string& name : {row.block_a, row.block_b})
      if (!block_of.contains(name)) throw InputError(row.where, fmt::format("no block is named '{}'", name));
    ties.push_back({block_of[row.block_a], block_of[row.block_b], to_world(source, row.point_a),
                    to_world(source, row.point_b), row.stiffness,
                    row.length * source.metres_per_unit.value_or(1.0), row.pushes});
    check_tie(ties.back(), row, assembly);
  }
  return ties;
}

/// m2, of the faces of a block in whose plane a polygon lies, as far as they have it in common: positive for
/// faces that look along the normal n, negative for those that look against it.
double facing(const Assembly& assembly, int block, const std::vector<Vec3>& polygon, const Vec3& n,
              const JointRule& rule) {
  double sum = 0.0;
  for (const PlanePolygon& face : faces_of_block(assembly, block)) {
    const double along = face.plane.normal.dot(n);
    const double gap = face.plane.normal.dot(polygon_centroid(polygon)) - face.plane.offset;
    if (std::abs(along) < std::cos(rule.max_angle) || std::abs(gap) > rule.margin) continue;
    const std::vector<Vec3> common = divide(polygon, face, 0.0).inside;
    if (!common.empty()) sum += std::copysign(polygon_area(common), along);
  }
  return sum;
}

/// The unit normal of an interface, from block a to block b. The side of a centroid is not that of the joint
/// where a block reaches round another: it decides only where the interface lies in no face.
Vec3 normal_of(const std::vector<Vec3>& interface, int a, int b, const Assembly& assembly,
               const JointRule& rule) {
  const Vec3 n = polygon_plane(interface).normal;
  const double out = facing(assembly, a, interface, n, rule) - facing(assembly, b, interface, n, rule),
               apart = n.dot(assembly.blocks[b].centroid - assembly.blocks[a].centroid);
  return (out != 0.0 ? out : apart) < 0.0 ? Vec3(-n) : n;
}

}  // namespace

Assembly import_blocks(const ImportedBlocks& source, double density, ImportReport* report) {
  ImportReport unused;
  if (!report) report = &unused;
  std::vector<RawBlock> raw = read_all(source);
  place_in_world(source, &raw);
  measure_extents(source, raw, report);
  Surfaces surfaces = repair_all(raw, report);
  const std::vector<double> drawn = drawn_volumes(surfaces, raw.size());
  const DecompositionOptions options = choose_tolerances(source, surfaces.meshes, report);
  if (report->snap > 0.0)
    report->snapped_facets = snap_facets(&surfaces.meshes, options, {report->snap, report->largest_gap});

  Assembly assembly;
  append_blocks(raw, surfaces, options, density, &assembly, report);
  if (std::ranges::all_of(report->course_numbers, [](int number) { return number == kNoCourse; }))
    report->course_numbers.clear();
  compute_mass_properties(&assembly);
  compare_volumes(drawn, assembly, report);
  report->unusual_size = unusual_size(source, *report);
  fix_supports(source, raw, *report, &assembly);
  for (size_t b = 0; b < raw.size(); ++b)
    report->uses_material |= !assembly.blocks[b].fixed && !raw[b].density;
  report->separate_solids = text_of_solids(report->solids, assembly);
  report->doubt_of_axes = doubt_of_axes(source, *report, assembly);
  assembly.ties = read_ties(source, raw, assembly);
  report->ties = static_cast<int>(assembly.ties.size());
  return assembly;
}

std::string contacts_csv(const ImportedBlocks& source, const Assembly& assembly, const ImportReport& report) {
  if (format_of(source, source.path) != ImportedBlocks::Format::compas)
    throw InputError(FileLocation{source.path}, "not a COMPAS assembly; only those contain interfaces");
  std::map<std::string, int> block_of;
  for (size_t b = 0; b < report.origins.size(); ++b) block_of[report.origins[b].name] = static_cast<int>(b);
  std::string csv = "block_a,block_b,joint,x,y,z,nx,ny,nz,gap_m,area_m2\n";
  const JointRule rule = joint_rule(smallest_block_size(assembly), 0.0);
  int joint = 0;
  for (const RawInterface& face : read_compas_interfaces(source.path)) {
    for (const std::string& name : {face.block_a, face.block_b})
      if (!block_of.contains(name)) throw InputError(face.where, fmt::format("no block is named '{}'", name));
    const int a = block_of[face.block_a], b = block_of[face.block_b];
    std::vector<Vec3> corners;
    for (const Vec3& p : face.points) corners.push_back(to_world(source, p));
    const Vec3 n = normal_of(corners, a, b, assembly, rule);
    const double area = polygon_area(corners) / static_cast<double>(corners.size());
    for (const Vec3& p : corners)
      csv += fmt::format("{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},0,{:.17g}\n", a, b, joint,
                         p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), area);
    ++joint;
  }
  return csv;
}

}  // namespace cupola
