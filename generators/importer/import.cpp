#include "generators/importer/import.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/base/counted.hpp"
#include "generators/decomposition/decompose.hpp"
#include "generators/importer/mesh_repair.hpp"
#include "generators/importer/readers.hpp"
#include "generators/importer/snap_facets.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;
using Format = ImportedBlocks::Format;

constexpr double kSliver = 1e-3;        // thickness over size of a part
constexpr double kSnapPerWarp = 4.0;    // two faces, each warped to both sides of its plane
constexpr double kLargestError = 0.01;  // of the smallest block: as the default of contact.margin
constexpr double kRoundedWarp =
    1e-9;  // of the block size; smaller deviations from planes are rounding of doubles

Format format_of(const fs::path& path) {
  static const std::map<std::string, Format> endings{
      {".obj", Format::obj},     {".off", Format::off},    {".stl", Format::stl},   {".ply", Format::ply},
      {".json", Format::compas}, {".csv", Format::bricks}, {".txt", Format::bricks}};
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto found = endings.find(ending);
  return found == endings.end() ? Format::automatic : found->second;
}

std::vector<RawBlock> read_file(const fs::path& path, Format format) {
  switch (format == Format::automatic ? format_of(path) : format) {
    case Format::obj:
      return read_obj(path.string());
    case Format::off:
      return read_off(path.string());
    case Format::stl:
      return read_stl(path.string());
    case Format::ply:
      return read_ply(path.string());
    case Format::compas:
      return read_compas(path.string());
    case Format::bricks:
      return read_bricks(path.string());
    case Format::automatic:
      break;
  }
  throw InputError(FileLocation{path.string()}, "unknown file ending; set geometry.import.format");
}

std::vector<RawBlock> read_all(const ImportedBlocks& source) {
  if (!fs::is_directory(source.path)) {
    if (!fs::exists(source.path)) throw InputError(FileLocation{source.path}, "no such file or folder");
    return read_file(source.path, source.format);
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(source.path)) {
    if (!entry.is_regular_file() || format_of(entry.path()) == Format::automatic) continue;
    const fs::path inside = fs::canonical(entry.path()).lexically_relative(fs::canonical(source.path));
    if (*inside.begin() == "..")
      throw InputError(FileLocation{entry.path().string()}, "is a link to a file outside the folder");
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  if (files.empty())
    throw InputError(FileLocation{source.path},
                     "no block files in this folder (.obj, .off, .stl, .ply, .json, .csv, .txt)");
  std::vector<RawBlock> blocks;
  for (const fs::path& file : files)
    for (RawBlock& block : read_file(file, source.format)) blocks.push_back(std::move(block));
  return blocks;
}

/// Converts a point from the units and axes of the file to metres with z up.
Vec3 to_world(const ImportedBlocks& source, const Vec3& p) {
  const Vec3 turned = source.up == ImportedBlocks::UpAxis::y ? Vec3(p.x(), -p.z(), p.y()) : p;
  return source.metres_per_unit.value_or(1.0) * turned;
}

/// Throws InputError for a name that no block has.
void check_names(const ImportedBlocks& source, const std::vector<std::string>& names,
                 const std::map<std::string, size_t>& block_of, const char* key) {
  for (const std::string& name : names)
    if (!block_of.contains(name))
      throw InputError(fmt::format("geometry.import.{}: {} has no block named '{}'", key, source.path, name));
}

/// Converts coordinates to metres with z up and applies the densities of the case. Throws InputError if two
/// blocks have the same name.
void place_in_world(const ImportedBlocks& source, std::vector<RawBlock>* blocks) {
  std::map<std::string, size_t> block_of;
  for (size_t b = 0; b < blocks->size(); ++b) {
    RawBlock& block = (*blocks)[b];
    const auto [it, is_new] = block_of.try_emplace(block.name, b);
    if (!is_new) {
      const FileLocation& first = (*blocks)[it->second].where;
      throw InputError(block.where, fmt::format("block {}: the same name is used at {}:{}", block.name,
                                                first.file, first.line));
    }
    for (Vec3& v : block.mesh.vertices) v = to_world(source, v);
    for (auto& part : block.point_parts)
      for (Vec3& v : part) v = to_world(source, v);
  }
  check_names(source, source.supports, block_of, "supports");
  for (const BlockDensity& change : source.densities) {
    check_names(source, change.blocks, block_of, "densities");
    for (const std::string& name : change.blocks) (*blocks)[block_of[name]].density = change.density;
  }
}

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

/// Repaired surfaces. A block given by point clouds has one per part, other blocks have one.
struct Surfaces {
  std::vector<TriangleMesh> meshes;
  std::vector<int> block;  // per mesh
};

void append_surfaces(const RawBlock& raw, int block, Surfaces* surfaces, ImportReport* report) {
  constexpr double kWeld = 1e-6;  // of the block size: vertices closer than this are merged
  if (raw.point_parts.empty()) {
    int doubled = 0;
    surfaces->meshes.push_back(repair_mesh(raw, kWeld, &doubled));
    report->doubled_faces += doubled;
    surfaces->block.push_back(block);
  }
  for (const auto& points : raw.point_parts) {
    surfaces->meshes.push_back(hull_mesh(raw, points));
    surfaces->block.push_back(block);
  }
}

/// Throws InputError with the defects of all blocks at once.
Surfaces repair_all(const std::vector<RawBlock>& blocks, ImportReport* report) {
  constexpr size_t kListed = 20;
  Surfaces surfaces;
  std::vector<std::string> defects;
  FileLocation first;
  for (size_t b = 0; b < blocks.size(); ++b) {
    try {
      append_surfaces(blocks[b], static_cast<int>(b), &surfaces, report);
    } catch (const InputError& defect) {
      const std::string text = defect.what(), mark = "error: ";
      defects.push_back(text.substr(text.find(mark) + mark.size()));
      if (defects.size() == 1) first = blocks[b].where;
    }
  }
  if (defects.empty()) return surfaces;
  const size_t more = defects.size() - std::min(kListed, defects.size());
  defects.resize(defects.size() - more);
  throw InputError(
      first, fmt::format("{}{}", fmt::join(defects, "; "),
                         more > 0 ? fmt::format("; and {} with defects", counted(more, "more block")) : ""));
}

/// m3, of a surface as drawn: each polygon as a fan about the mean of its corners, which for four corners
/// bounds the volume of the bilinear face.
double drawn_volume(const TriangleMesh& mesh) {
  const Vec3 origin = mesh.vertices.front();
  double volume = 0.0;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    volume += (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
  };
  for (std::vector<int>& triangles : triangles_of_polygons(mesh)) {
    std::vector<int> loop;
    if (triangles.size() > 1) loop = facet_loop(mesh, mean_facet(mesh, triangles));
    Vec3 mean = Vec3::Zero();
    for (const int v : loop) mean += mesh.vertices[v] / static_cast<double>(loop.size());
    for (size_t i = 0; i < loop.size(); ++i)
      add(mean, mesh.vertices[loop[i]], mesh.vertices[loop[(i + 1) % loop.size()]]);
    if (loop.empty())
      for (const int t : triangles) add(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
  }
  return volume;
}

/// m, cube root of the smallest volume.
double smallest_size(const std::vector<TriangleMesh>& meshes) {
  double volume = std::numeric_limits<double>::infinity();
  for (const TriangleMesh& mesh : meshes) volume = std::min(volume, drawn_volume(mesh));
  return std::cbrt(volume);
}

/// The tolerances of the case, or those that follow from the surfaces.
DecompositionOptions choose_tolerances(const ImportedBlocks& source, const std::vector<TriangleMesh>& meshes,
                                       ImportReport* report) {
  report->flatness = measure_flatness(meshes);
  DecompositionOptions options;
  options.facet_angle = source.facet_angle.value_or(report->flatness.facet_angle);
  options.flat = source.facet_angle.value_or(report->flatness.flat);
  report->facet_angle = options.facet_angle;
  report->chosen = !source.facet_angle || !source.snap;
  if (source.snap) {
    report->snap = *source.snap;
    return options;
  }
  const bool exact = report->flatness.relative_warp < kRoundedWarp;
  const double of_warp = exact ? 0.0 : kSnapPerWarp * report->flatness.warp;
  report->snap_of_gaps = snap_from_gaps(meshes, options, kLargestError * smallest_size(meshes));
  report->snap = std::max(of_warp, report->snap_of_gaps.value_or(0.0));
  return options;
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

std::vector<double> drawn_volumes(const Surfaces& surfaces, size_t num_blocks) {
  std::vector<double> volumes(num_blocks, 0.0);
  for (size_t m = 0; m < surfaces.meshes.size(); ++m)
    volumes[surfaces.block[m]] += drawn_volume(surfaces.meshes[m]);
  return volumes;
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

void fix(int block, Assembly* assembly) {
  assembly->blocks[block].fixed = true;
  assembly->blocks[block].kind = BlockKind::support;
  assembly->blocks[block].ring = -1;
  for (Part& part : assembly->parts)
    if (part.block == block) part.ring = -1;
}

/// Per block, the z of its lowest corner, m.
std::vector<double> lowest_corners(const Assembly& assembly) {
  std::vector<double> lowest(assembly.blocks.size(), std::numeric_limits<double>::infinity());
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const int v : assembly.face(f))
        lowest[part.block] = std::min(lowest[part.block], assembly.vertices[v].z());
  return lowest;
}

void fix_supports(const ImportedBlocks& source, const std::vector<RawBlock>& raw, const ImportReport& report,
                  Assembly* assembly) {
  constexpr double kSamePlane = 1e-3;  // of the height of the model
  const std::set<std::string> named(source.supports.begin(), source.supports.end());
  const std::vector<double> lowest = lowest_corners(*assembly);
  const double plane = report.low.z() + kSamePlane * (report.high.z() - report.low.z());
  for (size_t b = 0; b < raw.size(); ++b)
    if (named.contains(raw[b].name) || (source.flagged_supports && raw[b].fixed) ||
        (source.fixed_below && assembly->blocks[b].centroid.z() < *source.fixed_below) ||
        (source.fixed_by == ImportedBlocks::SupportRule::lowest && lowest[b] <= plane))
      fix(static_cast<int>(b), assembly);
}

/// If the supports lie at the lower end of the file's y axis and not at that of z, y is probably upward.
std::string doubt_of_axes(const ImportedBlocks& source, const ImportReport& report,
                          const Assembly& assembly) {
  constexpr double kBottom = 0.15, kMiddle = 0.25;  // of the extents
  const Vec3 extents = report.high - report.low;
  Vec3 mean = Vec3::Zero();
  double highest = 0.0;
  int count = 0;
  for (const Block& block : assembly.blocks) {
    if (!block.fixed) continue;
    const Vec3 share = (block.centroid - report.low).cwiseQuotient(extents);
    mean += share;
    highest = std::max(highest, share.y());
    ++count;
  }
  if (count == 0 || source.up == ImportedBlocks::UpAxis::y || highest > kBottom) return {};
  if (mean.z() / count < kMiddle) return {};
  return "all supports lie at the lower end of y, and not at that of z: if y is upward in the file, set "
         "geometry.import.up: y";
}

/// m, mean size of the blocks if it is that of no stone or brick and the case does not state the unit; else
/// 0.
double unusual_size(const ImportedBlocks& source, const ImportReport& report) {
  constexpr double kSmallest = 0.02, kLargest = 10.0;
  const double size = std::cbrt(report.volume_of_parts / static_cast<double>(report.origins.size()));
  return source.metres_per_unit || (size >= kSmallest && size <= kLargest) ? 0.0 : size;
}

std::vector<BuiltTie> read_ties(const ImportedBlocks& source, const std::vector<RawBlock>& raw) {
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
  }
  return ties;
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
  if (report->snap > 0.0) report->snapped_facets = snap_facets(&surfaces.meshes, options, report->snap);

  Assembly assembly;
  append_blocks(raw, surfaces, options, density, &assembly, report);
  compute_mass_properties(&assembly);
  compare_volumes(drawn, assembly, report);
  report->unusual_size = unusual_size(source, *report);
  fix_supports(source, raw, *report, &assembly);
  report->doubt_of_axes = doubt_of_axes(source, *report, assembly);
  assembly.ties = read_ties(source, raw);
  report->ties = static_cast<int>(assembly.ties.size());
  return assembly;
}

int fix_ends(const ImportedBlocks& source, std::span<const FacePair> joints, Assembly* assembly) {
  if (source.fixed_by != ImportedBlocks::SupportRule::one_neighbour) return 0;
  std::vector<std::set<int>> neighbours(assembly->blocks.size());
  for (const FacePair& joint : joints) {
    const int a = assembly->parts[joint.part_a].block, b = assembly->parts[joint.part_b].block;
    neighbours[a].insert(b);
    neighbours[b].insert(a);
  }
  int ends = 0;
  for (size_t b = 0; b < neighbours.size(); ++b) {
    if (neighbours[b].size() != 1 || assembly->blocks[b].fixed) continue;
    fix(static_cast<int>(b), assembly);
    ++ends;
  }
  return ends;
}

std::vector<std::string> warnings_of(const ImportReport& r) {
  constexpr double kNoticeable = 0.01;  // of a volume
  std::vector<std::string> warnings;
  if (r.sliver_parts > 0)
    warnings.push_back(fmt::format("{}, thinner than 1e-3 of the size",
                                   counted(r.sliver_parts, "part is a sliver", "parts are slivers")));
  if (r.doubled_faces > 0)
    warnings.push_back(counted(r.doubled_faces, "face repeats", "faces repeat") +
                       " another one of the same block; the repetition is dropped");
  if (r.drawn_volume > 0.0 && std::abs(r.volume_of_parts / r.drawn_volume - 1.0) > kNoticeable)
    warnings.push_back(fmt::format(
        "the blocks have {:.4g} m3, and their drawing {:.4g} m3: warped faces were split into plane ones",
        r.volume_of_parts, r.drawn_volume));
  if (std::abs(r.most_changed) > kNoticeable)
    warnings.push_back(fmt::format(
        "block {} has {:.1f} % {} volume than its drawing: its warped faces were split into plane ones",
        r.origins[static_cast<size_t>(r.most_changed_block)].name, 100.0 * std::abs(r.most_changed),
        r.most_changed > 0.0 ? "more" : "less"));
  if (r.unusual_size > 0.0)
    warnings.push_back(fmt::format(
        "the blocks are {:.2g} m in size; if the file is not in metres, set geometry.import.metres_per_unit",
        r.unusual_size));
  if (!r.doubt_of_axes.empty()) warnings.push_back(r.doubt_of_axes);
  return warnings;
}

std::string to_text(const ImportReport& r) {
  std::string text = fmt::format(
      "{} imported: {} already convex, {} split by planes, {} by their cross-section, "
      "{} by Nef polyhedra; largest relative volume error {:.1e}\n",
      counted(r.origins.size(), "block"), counted(r.already_convex, "piece"), r.by_planes, r.as_prisms,
      r.by_nef, r.largest_volume_error);
  text += fmt::format(
      "extents x {:.4g} to {:.4g} m, y {:.4g} to {:.4g} m, z {:.4g} to {:.4g} m; volume {:.6g} m3, as drawn "
      "{:.6g} m3\n",
      r.low.x(), r.high.x(), r.low.y(), r.high.y(), r.low.z(), r.high.z(), r.volume_of_parts, r.drawn_volume);
  if (r.courses.courses > 0)
    text += fmt::format("{} found: {}\n", counted(r.courses.courses, "course"), r.courses.kind);
  else if (!r.courses.refusal.empty())
    text += fmt::format("no courses: {}\n", r.courses.refusal);
  constexpr int kListed = 10;
  int several = 0;
  for (size_t b = 0; b < r.origins.size(); ++b)
    if (r.parts[b] > 1 && ++several <= kListed)
      text += fmt::format("  block {}: {}\n", r.origins[b].name, counted(r.parts[b], "convex part"));
  if (several > kListed)
    text += fmt::format("  {} with several convex parts; --report lists all\n",
                        counted(several - kListed, "more block"));
  const bool of_gaps = r.snap_of_gaps && r.snap == *r.snap_of_gaps;
  const std::string moved = counted(r.snapped_facets, "facet") + " moved to common planes";
  if (r.flatness.relative_warp >= kRoundedWarp)
    text += fmt::format(
        "faces deviate from planes by up to {:.2g} m, {:.1g} of the size of their block; facet_angle = "
        "{:.2g} rad and snap = {:.2g} m{}: {}\n",
        r.flatness.warp, r.flatness.relative_warp, r.facet_angle, r.snap,
        of_gaps    ? ", for faces that gape or overlap by up to half of that"
        : r.chosen ? ", chosen from that"
                   : "",
        moved);
  else if (of_gaps)
    text += fmt::format(
        "faces that meet gape or overlap by up to {:.2g} m; snap = {:.2g} m, chosen from that: {}\n",
        0.5 * r.snap, r.snap, moved);
  else if (r.snapped_facets > 0)
    text += moved + "\n";
  if (r.flatness.bent > 0)
    text += fmt::format("{} warped by more than 0.05 rad: counted as several triangles\n",
                        counted(r.flatness.bent, "face"));
  if (r.sliver_parts + r.by_nef > 0)
    text += fmt::format(
        "note: slivers and Nef polyhedra often mean that faces made of triangles are not quite plane; "
        "geometry.import.facet_angle is {:.2g} rad, a larger value joins them\n",
        r.facet_angle);
  if (r.ties > 0) text += counted(r.ties, "tie") + "\n";
  return text;
}

std::string contacts_csv(const ImportedBlocks& source, const Assembly& assembly, const ImportReport& report) {
  const bool compas = source.format == Format::compas ||
                      (source.format == Format::automatic && format_of(source.path) == Format::compas);
  if (!compas)
    throw InputError(FileLocation{source.path}, "not a COMPAS assembly; only those contain interfaces");
  std::map<std::string, int> block_of;
  for (size_t b = 0; b < report.origins.size(); ++b) block_of[report.origins[b].name] = static_cast<int>(b);
  std::string csv = "block_a,block_b,joint,x,y,z,nx,ny,nz,gap_m,area_m2\n";
  int joint = 0;
  for (const RawInterface& face : read_compas_interfaces(source.path)) {
    for (const std::string& name : {face.block_a, face.block_b})
      if (!block_of.contains(name)) throw InputError(face.where, fmt::format("no block is named '{}'", name));
    const int a = block_of[face.block_a], b = block_of[face.block_b];
    std::vector<Vec3> corners;
    for (const Vec3& p : face.points) corners.push_back(to_world(source, p));
    Vec3 n = polygon_plane(corners).normal;
    if (n.dot(assembly.blocks[b].centroid - assembly.blocks[a].centroid) < 0.0) n = -n;
    const double area = polygon_area(corners) / static_cast<double>(corners.size());
    for (const Vec3& p : corners)
      csv += fmt::format("{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},0,{:.17g}\n", a, b, joint,
                         p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), area);
    ++joint;
  }
  return csv;
}

}  // namespace cupola
