#include "generators/stereotomy/model_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/disjoint_sets.hpp"
#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"
#include "generators/stereotomy/mesh_checks.hpp"
#include "generators/stereotomy/separation.hpp"

namespace cupola {
namespace {

/// m, of any vertex: coordinates are rounded in proportion to it.
double largest_coordinate(const Assembly& assembly) {
  double largest = 0.0;
  for (const Vec3& v : assembly.vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  return largest;
}

double model_size(const Assembly& assembly) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& v : assembly.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  return (high - low).maxCoeff();
}

/// Names and sources of blocks, for messages.
struct Names {
  std::span<const BlockOrigin> origins;

  std::string name(int block) const { return origins.empty() ? std::to_string(block) : origins[block].name; }
  [[noreturn]] void fail(int block, const std::string& message) const {
    if (origins.empty()) throw InputError(message);
    throw InputError(origins[block].where, message);
  }
  /// What to change if a face is not plane.
  std::string hint() const {
    return origins.empty() ? ""
                           : "; if its faces are made of triangles, increase geometry.import.facet_angle";
  }
  /// The name with file and line, for a block other than the one that the message begins with.
  std::string with_source(int block) const {
    if (origins.empty()) return name(block);
    return fmt::format("{} ({}:{})", name(block), origins[block].where.file, origins[block].where.line);
  }
};

void check_boundaries(const Assembly& assembly, bool part_by_part, const Names& names) {
  const std::vector<BoundaryDefect> defects = find_boundary_defects(assembly, part_by_part);
  if (defects.empty()) return;
  const BoundaryDefect& d = defects.front();
  using enum BoundaryDefect::Kind;
  const std::string what = d.kind == open
                               ? fmt::format("not closed, {}", counted(d.boundary_edges, "boundary edge"))
                               : "inside out";
  names.fail(d.block,
             fmt::format("block {}: {}{}", names.name(d.block), what,
                         defects.size() > 1 ? fmt::format(" ({} defects in all)", defects.size()) : ""));
}

void measure_shape(const Assembly& assembly, const ConvexShape& shape, double bound, int block,
                   const Names& names, ModelReport* report) {
  for (size_t i = 0; i < shape.planes.size(); ++i) {
    const Plane& plane = shape.planes[i];
    double above = 0.0, off = 0.0;
    for (const Vec3& v : shape.vertices) above = std::max(above, plane.normal.dot(v) - plane.offset);
    const std::vector<Vec3> corners = face_points(assembly, shape.faces[i]);
    for (size_t j = 0; j < corners.size(); ++j) {
      off = std::max(off, std::abs(plane.normal.dot(corners[j]) - plane.offset));
      report->shortest_edge =
          std::min(report->shortest_edge, (corners[(j + 1) % corners.size()] - corners[j]).norm());
    }
    report->max_convexity_error = std::max(report->max_convexity_error, above);
    report->max_planarity_error = std::max(report->max_planarity_error, off);
    if (off > bound)
      names.fail(
          block,
          fmt::format("block {}: a vertex lies {:.3g} m off the plane of its face, more than {:.3g} m{}",
                      names.name(block), off, bound, names.hint()));
    if (above > bound)
      names.fail(block,
                 fmt::format("block {}: a vertex lies {:.3g} m outside a face of its convex part, more than "
                             "{:.3g} m{}",
                             names.name(block), above, bound, names.hint()));
  }
}

/// Two faces opposite each other.
struct Meeting {
  double gap = 0.0;    // m, between their planes
  double width = 0.0;  // m, of their overlap
  int face_a = 0, face_b = 0;
};

/// The widest overlap of two opposed faces within the gap of a joint, or none.
std::optional<Meeting> meeting_of(const Assembly& assembly, const ConvexShape& a, const ConvexShape& b,
                                  const ModelTolerances& tolerances) {
  const double opposed = -std::cos(tolerances.joint_angle);
  std::optional<Meeting> widest;
  for (size_t i = 0; i < a.planes.size(); ++i)
    for (size_t j = 0; j < b.planes.size(); ++j) {
      const Plane& p = a.planes[i];
      const Plane& q = b.planes[j];
      if (p.normal.dot(q.normal) > opposed) continue;
      const std::vector<Vec3> face_a = face_points(assembly, a.faces[i]),
                              face_b = face_points(assembly, b.faces[j]);
      const double gap = std::abs(p.normal.dot(polygon_centroid(face_b)) - p.offset);
      if (gap > tolerances.joint_gap) continue;
      double width = overlap_width(face_a, face_b, p.normal);
      if (width > 0.0) width = common_width(face_a, face_b);
      if (!widest || width > widest->width) widest = {gap, width, a.faces[i], b.faces[j]};
      if (widest->width > tolerances.joint_width) return widest;
    }
  return widest;
}

/// Of two blocks of different members, which these are and where the blocks lie. Of one member, which of them
/// is its support.
std::string places_of_members(const Assembly& assembly, int a, int b) {
  if (assembly.sheets.size() < 2) {
    if (!assembly.blocks[a].fixed && !assembly.blocks[b].fixed) return {};
    return fmt::format("; block {} is a support: reduce geometry.support_width",
                       assembly.blocks[a].fixed ? a : b);
  }
  const auto name = [&](int block) {
    const Sheet* sheet = assembly.sheet_of(assembly.blocks[block].ring);
    return sheet ? "the member " + sheet->name : std::string("a support");
  };
  if (name(a) == name(b) && !assembly.blocks[a].fixed) return {};
  const Vec3& p = assembly.blocks[b].centroid;
  const Sheet* sheet = assembly.sheet_of(assembly.blocks[a].ring);
  const int of_a = assembly.blocks[a].member, of_b = assembly.blocks[b].member;
  const bool are_copies = of_a != of_b && !assembly.member_originals.empty() &&
                          assembly.member_originals[of_a] == assembly.member_originals[of_b];
  const std::string cure = !are_copies ? "move one member by `at`"
                           : sheet && sheet->on_previous
                               ? "each copy of a member bears a copy of what stands on it: stand that on one "
                                 "without copies, and list the others as a member after it"
                               : "move the copies apart";
  return fmt::format(" ({} and {}) about ({:.4g}, {:.4g}, {:.4g}) m; {}", name(a), name(b), p.x(), p.y(),
                     p.z(), cure);
}

/// Pairs of blocks that overlap by more than the bound, and by how much (m).
using Overlaps = std::map<std::pair<int, int>, double>;

std::set<std::pair<int, int>> joined_sheets(const Assembly& assembly,
                                            const std::vector<std::pair<int, int>>& joints) {
  std::set<std::pair<int, int>> joined;
  for (const auto& [a, b] : joints) {
    const Sheet* one = assembly.sheet_of(assembly.blocks[a].ring);
    const Sheet* other = assembly.sheet_of(assembly.blocks[b].ring);
    if (!one || !other || one == other || assembly.blocks[a].fixed || assembly.blocks[b].fixed) continue;
    const Sheet* first = assembly.sheets.data();
    joined.insert(std::minmax(static_cast<int>(one - first), static_cast<int>(other - first)));
  }
  return joined;
}

std::vector<char> borne_rings(const Assembly& assembly, const std::vector<std::pair<int, int>>& joints) {
  std::vector<char> is_borne(static_cast<size_t>(assembly.num_rings), 0);
  for (const auto& [a, b] : joints)
    if (assembly.sheet_of(assembly.blocks[a].ring) != assembly.sheet_of(assembly.blocks[b].ring))
      for (const int block : {a, b})
        if (!assembly.blocks[block].fixed) is_borne[assembly.blocks[block].ring] = 1;
  return is_borne;
}

std::vector<HangingCorner> find_hanging_corners(const Assembly& assembly,
                                                const std::vector<std::pair<int, int>>& joints) {
  const std::vector<Block>& blocks = assembly.blocks;
  std::vector<HangingCorner> hanging;
  for (const Sheet& sheet : assembly.sheets) {
    if (sheet.thrust_lines != Sheet::ThrustLines::radial) continue;
    const auto springs = [&](int b) { return !blocks[b].fixed && blocks[b].ring == sheet.first_ring; };
    DisjointSets corners(blocks.size());
    std::vector<char> is_borne(blocks.size(), 0);
    for (const auto& [a, b] : joints) {
      if (springs(a) && springs(b)) corners.join(a, b);
      if (springs(a) && !sheet.has_ring(blocks[b].ring)) is_borne[a] = 1;
      if (springs(b) && !sheet.has_ring(blocks[a].ring)) is_borne[b] = 1;
    }
    std::map<int, bool> borne;  // by corner
    for (int b = 0; b < static_cast<int>(blocks.size()); ++b)
      if (springs(b)) borne[corners.root(b)] = borne[corners.root(b)] || is_borne[b] != 0;
    for (const auto& [corner, is_one] : borne)
      if (!is_one) hanging.push_back({corner, blocks[corner].centroid, sheet.name});
  }
  return hanging;
}

/// Names all pairs at once, the deepest first, and the margin that admits them.
[[noreturn]] void refuse_overlaps(const Assembly& assembly, const Overlaps& overlaps,
                                  const ModelTolerances& tolerances, const Names& names) {
  constexpr size_t kListed = 20;
  std::vector<std::pair<double, std::pair<int, int>>> deepest;
  for (const auto& [pair, depth] : overlaps) deepest.emplace_back(-depth, pair);
  std::ranges::sort(deepest);
  const auto [a, b] = deepest.front().second;
  const double largest = -deepest.front().first;
  const bool is_imported = !names.origins.empty();
  std::string text =
      fmt::format("{}blocks {} and {} overlap by {:.3g} m{}", is_imported ? "" : "geometry: ", names.name(a),
                  names.with_source(b), largest, is_imported ? "" : places_of_members(assembly, a, b));
  if (tolerances.part_by_part && is_imported) {
    constexpr double kMostMargin = 0.1;  // of a block: with a larger one it would bear from inside another
    const double margin = 1.05 * largest,
                 size = std::cbrt(std::min(assembly.blocks[a].volume, assembly.blocks[b].volume));
    text += fmt::format(", more than contact.margin = {:.3g} m: correct the geometry{}", tolerances.overlap,
                        margin <= kMostMargin * size
                            ? fmt::format(" or increase contact.margin to {:.2g} m", margin)
                            : ", in which one may be drawn twice or inside the other");
  }
  if (deepest.size() > 1) text += fmt::format("; {} overlap:", counted(deepest.size(), "pair"));
  for (size_t i = 0; deepest.size() > 1 && i < std::min(kListed, deepest.size()); ++i)
    text += fmt::format("{} {} and {} by {:.3g} m", i == 0 ? "" : ",", names.name(deepest[i].second.first),
                        names.name(deepest[i].second.second), -deepest[i].first);
  if (deepest.size() > kListed) text += fmt::format(", and {} more", deepest.size() - kListed);
  names.fail(a, text);
}

/// Finds what hangs together by joints, by ties, and by contacts `touching` at an edge or a corner.
void connect_blocks(const Assembly& assembly, const std::vector<std::pair<int, int>>& joints,
                    const std::vector<std::pair<int, int>>& touching, ModelReport* report) {
  DisjointSets islands(assembly.blocks.size());
  std::vector<char> has_joint(assembly.blocks.size(), 0), touches(assembly.blocks.size(), 0);
  for (const auto& [a, b] : joints) {
    has_joint[a] = has_joint[b] = 1;
    islands.join(a, b);
  }
  for (const auto& [a, b] : touching) {
    touches[a] = touches[b] = 1;
    islands.join(a, b);
  }
  for (const BuiltTie& tie : assembly.ties) {
    has_joint[tie.block_a] = has_joint[tie.block_b] = 1;
    islands.join(tie.block_a, tie.block_b);
  }
  std::vector<char> is_held(assembly.blocks.size(), 0);
  for (int b = 0; b < static_cast<int>(assembly.blocks.size()); ++b)
    if (assembly.blocks[b].fixed) is_held[islands.root(b)] = 1;
  for (int b = 0; b < static_cast<int>(assembly.blocks.size()); ++b) {
    if (islands.root(b) == b) ++report->islands;
    if (!report->floating && is_held[islands.root(b)] == 0) report->floating = b;
    if (!has_joint[b] && !touches[b]) report->blocks_without_joint.push_back(b);
    if (!has_joint[b] && touches[b] && !assembly.blocks[b].fixed) ++report->blocks_on_edges;
  }
}

void check_pairs(const Assembly& assembly, const std::vector<ConvexShape>& shapes,
                 const ModelTolerances& tolerances, const Names& names, ModelReport* report) {
  std::vector<std::pair<int, int>> joints, touching;  // pairs of blocks; touching: at an edge or a corner
  std::vector<NarrowJoint> narrow;
  Overlaps overlaps;
  const ModelTolerances rounding = generated_tolerances(assembly);
  const double good_enough = std::min(tolerances.overlap, rounding.overlap);
  const double no_width = std::max(kNoWidth * tolerances.joint_width, rounding.joint_width);
  report->max_overlap = -std::numeric_limits<double>::infinity();
  visit_near_pairs(assembly, tolerances.joint_gap, [&](int p, int q) {
    const int a = std::min(assembly.parts[p].block, assembly.parts[q].block);
    const int b = std::max(assembly.parts[p].block, assembly.parts[q].block);
    const auto is_ground = [&](int block) { return assembly.blocks[block].kind == BlockKind::support; };
    if (a != b && is_ground(a) && is_ground(b)) return;  // supports of two members may overlap
    const double depth = overlap_depth(shapes[p], shapes[q], good_enough);
    if (a == b) {
      if (depth > tolerances.overlap)
        names.fail(a, fmt::format("block {}: two of its parts overlap by {:.3g} m", names.name(a), depth));
      return;
    }
    report->max_overlap = std::max(report->max_overlap, depth);
    if (depth > tolerances.overlap) {
      double& deepest = overlaps[{a, b}];
      deepest = std::max(deepest, depth);
      return;
    }
    if (depth < -tolerances.joint_gap) return;
    const std::optional<Meeting> meeting = meeting_of(assembly, shapes[p], shapes[q], tolerances);
    if (meeting && meeting->width > tolerances.joint_width) {
      report->max_joint_gap = std::max(report->max_joint_gap, meeting->gap);
      joints.emplace_back(a, b);
      if (tolerances.part_by_part) report->joint_faces.push_back({p, q, meeting->face_a, meeting->face_b});
    } else if (meeting && meeting->width > no_width) {
      narrow.push_back({a, b, meeting->width});
    } else if (!meeting && tolerances.part_by_part &&
               overlap_depth(shapes[p], shapes[q], -tolerances.joint_gap) >= -tolerances.joint_gap) {
      touching.emplace_back(a, b);  // on every axis, not only on the first that was good enough
    }
  });
  if (!overlaps.empty()) refuse_overlaps(assembly, overlaps, tolerances, names);
  std::ranges::sort(joints);
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  report->num_joints = static_cast<int>(joints.size());
  report->joined_sheets = joined_sheets(assembly, joints);
  report->is_borne = borne_rings(assembly, joints);
  report->hanging_corners = find_hanging_corners(assembly, joints);
  for (const NarrowJoint& joint : narrow)
    if (!std::ranges::binary_search(joints, std::pair(joint.block_a, joint.block_b)))
      report->narrow_joints.push_back(joint);
  connect_blocks(assembly, joints, touching, report);
}

}  // namespace

ModelTolerances generated_tolerances(const Assembly& assembly) {
  // Far from the origin coordinates are rounded to more than these shares of the model.
  constexpr double kRoundings = 16.0;
  const double size = model_size(assembly),
               rounding = kRoundings * std::numeric_limits<double>::epsilon() * largest_coordinate(assembly);
  const double touch = std::max(2e-11 * size, rounding);
  return {std::max(1e-13 * size, rounding), touch, touch, touch, 1e-6, false};
}

ModelTolerances imported_tolerances(const Assembly& assembly, double facet_angle, const JointRule& rule) {
  const double plane = std::max(1e-5, facet_angle) * model_size(assembly);
  return {plane, rule.margin, rule.margin, rule.min_width, rule.max_angle, true};
}

ModelReport check_model(const Assembly& assembly, const ModelTolerances& tolerances,
                        std::span<const BlockOrigin> origins) {
  const Names names{origins};
  ModelReport report;
  report.smallest_block = std::numeric_limits<double>::infinity();
  report.shortest_edge = std::numeric_limits<double>::infinity();
  for (const Block& block : assembly.blocks) {
    if (block.kind == BlockKind::support) {
      ++report.num_supports;
      continue;
    }
    ++report.num_blocks;
    report.volume += block.volume;
    report.smallest_block = std::min(report.smallest_block, block.volume);
    report.largest_block = std::max(report.largest_block, block.volume);
  }
  CUPOLA_ASSERT(origins.empty() || origins.size() == assembly.blocks.size());
  check_boundaries(assembly, tolerances.part_by_part, names);
  std::vector<ConvexShape> shapes;
  for (const Part& part : assembly.parts) {
    shapes.push_back(convex_shape(assembly, part));
    measure_shape(assembly, shapes.back(), tolerances.plane, part.block, names, &report);
    if (assembly.blocks[part.block].kind == BlockKind::support) continue;
    ++report.num_parts;
    report.parts_volume += part.volume;
  }
  check_pairs(assembly, shapes, tolerances, names, &report);
  return report;
}

std::string to_text(const ModelReport& r) {
  std::string text = fmt::format(
      "{} in {}, {}, {}, {}\n"
      "volume {:.9g} m3, blocks {:.4g} to {:.4g} m3\n",
      counted(r.num_blocks, "block"), counted(r.num_parts, "convex part"), counted(r.num_supports, "support"),
      counted(r.num_joints, "joint"), counted(r.islands, "connected component"), r.volume, r.smallest_block,
      r.largest_block);
  if (r.blocks_on_edges > 0)
    text += fmt::format(
        "{} in contact at edges or corners only, where the solver finds joints that are not counted here\n",
        counted(r.blocks_on_edges, "block"));
  if (r.shell_volume)
    text += fmt::format("smooth shell {:.9g} m3; the facets reduce it by a fraction of {:.3e}\n",
                        *r.shell_volume, 1.0 - r.volume / *r.shell_volume);
  text += fmt::format(
      "largest errors: convexity {:.1e} m, planarity {:.1e} m, overlap of blocks {:.1e} m, gap in a "
      "joint {:.1e} m; shortest edge {:.4g} m\n",
      r.max_convexity_error, r.max_planarity_error, std::max(r.max_overlap, 0.0), r.max_joint_gap,
      r.shortest_edge);
  return text;
}

std::vector<std::string> warnings_of(const ModelReport& r, std::span<const BlockOrigin> origins) {
  std::vector<std::string> warnings;
  const Names names{origins};
  if (r.blocks_without_joint.size() == 1)
    warnings.push_back(fmt::format("block {} has no joint; supports have none with each other",
                                   names.name(r.blocks_without_joint.front())));
  if (r.blocks_without_joint.size() > 1)
    warnings.push_back(fmt::format("{} have no joint, the first is {}",
                                   counted(r.blocks_without_joint.size(), "block"),
                                   names.name(r.blocks_without_joint.front())));
  for (const NarrowJoint& joint : r.narrow_joints)
    warnings.push_back(fmt::format(
        "blocks {} and {}: their joint is only {:.3g} m wide, less than 1e-3 of the smallest block, "
        "and is ignored",
        names.name(joint.block_a), names.name(joint.block_b), joint.width));
  for (const HangingCorner& corner : r.hanging_corners)
    warnings.push_back(fmt::format(
        "a corner of the member {} hangs in the air: no pier or support is under its springer, block {} "
        "about ({:.4g}, {:.4g}, {:.4g}) m",
        corner.member, corner.block, corner.centroid.x(), corner.centroid.y(), corner.centroid.z()));
  if (r.num_supports == 0) warnings.emplace_back(kNoBlockIsFixed);
  return warnings;
}

}  // namespace cupola
