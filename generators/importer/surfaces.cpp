#include "generators/importer/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/disjoint_sets.hpp"
#include "generators/importer/mesh_repair.hpp"
#include "generators/importer/snap_facets.hpp"

namespace cupola {
namespace {

constexpr double kSnapPerWarp = 4.0;    // two faces, each warped to both sides of its plane
constexpr double kLargestError = 0.01;  // of the smallest block: as the default of contact.margin

/// Number of its outer surfaces; those of cavities have a negative volume.
int count_solids(const TriangleMesh& mesh) {
  const std::vector<std::array<int, 3>> neighbours = triangle_neighbours(mesh);
  DisjointSets surfaces(neighbours.size());
  for (size_t t = 0; t < neighbours.size(); ++t)
    for (const int next : neighbours[t]) surfaces.join(static_cast<int>(t), next);
  std::map<int, double> volume;
  for (int t = 0; t < static_cast<int>(neighbours.size()); ++t) {
    const int root = surfaces.root(t);
    const Vec3& origin = mesh.corner(root, 0);
    volume[root] +=
        (mesh.corner(t, 0) - origin).dot((mesh.corner(t, 1) - origin).cross(mesh.corner(t, 2) - origin));
  }
  return static_cast<int>(std::ranges::count_if(volume, [](const auto& v) { return v.second > 0.0; }));
}

void append_surfaces(const RawBlock& raw, int block, Surfaces* surfaces, ImportReport* report) {
  constexpr double kWeld = 1e-6;  // of the block size: vertices closer than this are merged
  if (raw.point_parts.empty()) {
    int doubled = 0;
    surfaces->meshes.push_back(repair_mesh(raw, kWeld, &doubled));
    report->doubled_faces += doubled;
    report->solids.back() = count_solids(surfaces->meshes.back());
    surfaces->block.push_back(block);
  }
  for (const auto& points : raw.point_parts) {
    surfaces->meshes.push_back(hull_mesh(raw, points));
    surfaces->block.push_back(block);
  }
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

}  // namespace

Surfaces repair_all(const std::vector<RawBlock>& blocks, ImportReport* report) {
  constexpr size_t kListed = 20;
  Surfaces surfaces;
  std::vector<std::string> defects;
  FileLocation first;
  for (size_t b = 0; b < blocks.size(); ++b) {
    report->solids.push_back(1);
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

std::vector<double> drawn_volumes(const Surfaces& surfaces, size_t num_blocks) {
  std::vector<double> volumes(num_blocks, 0.0);
  for (size_t m = 0; m < surfaces.meshes.size(); ++m)
    volumes[surfaces.block[m]] += drawn_volume(surfaces.meshes[m]);
  return volumes;
}

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
  const bool exact = report->flatness.relative_warp < ImportReport::kRoundedWarp;
  const double of_warp = exact ? 0.0 : kSnapPerWarp * report->flatness.warp;
  report->largest_gap = kLargestError * smallest_size(meshes);
  report->snap_of_gaps = snap_from_gaps(meshes, options, report->largest_gap);
  report->snap = std::max(of_warp, report->snap_of_gaps.value_or(0.0));
  return options;
}

}  // namespace cupola
