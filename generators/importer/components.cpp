#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/disjoint_sets.hpp"
#include "generators/importer/readers.hpp"

namespace cupola {
namespace {

/// A face at an edge from u to v, u < v.
struct Wing {
  int face = 0;
  bool forwards = false;  ///< the face runs through the edge from u to v
};

std::map<std::pair<int, int>, std::vector<Wing>> wings_of_edges(const PolygonMesh& mesh) {
  std::map<std::pair<int, int>, std::vector<Wing>> wings;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<int>& face = mesh.faces[f];
    const size_t n = face.size();
    for (size_t i = 0; i < n; ++i) {
      const int u = face[i], v = face[(i + 1) % n];
      if (u != v) wings[std::minmax(u, v)].push_back({static_cast<int>(f), u < v});
    }
  }
  return wings;
}

/// True if an edge bounds one face only, as all do in files that repeat the vertices of each face.
bool is_open(const PolygonMesh& mesh) {
  return std::ranges::any_of(wings_of_edges(mesh), [](const auto& edge) { return edge.second.size() == 1; });
}

/// Of unit length, into the face and across the edge from u to v.
Vec3 inwards(const PolygonMesh& mesh, const Vec3& edge, const Wing& wing) {
  std::vector<Vec3> corners;
  for (const int v : mesh.faces[wing.face]) corners.push_back(mesh.vertices[v]);
  return polygon_plane(corners).normal.cross(wing.forwards ? edge : Vec3(-edge)).stableNormalized();
}

/// rad, of the turn about the edge from a face that runs backwards through the solid to one that runs
/// forwards. Above 0: faces that coincide belong to two solids.
double angle_through_solid(const Vec3& edge, const Vec3& backwards, const Vec3& forwards) {
  constexpr double kCoincide = 1e-3;  // rad: coordinates have seven digits, and stones are not so sharp
  const double angle = std::atan2(edge.dot(backwards.cross(forwards)), backwards.dot(forwards));
  return angle > kCoincide ? angle : angle + 2.0 * std::numbers::pi;
}

/// The connected surfaces: faces are joined across edges. At an edge that several solids share, a face is
/// joined with the other face of the solid that it bounds.
DisjointSets surfaces_of(const PolygonMesh& mesh) {
  DisjointSets surfaces(mesh.faces.size());
  for (const auto& [ends, wings] : wings_of_edges(mesh)) {
    const auto forwards = std::ranges::count_if(wings, &Wing::forwards);
    if (wings.size() <= 2 || 2 * forwards != std::ssize(wings)) {
      for (const Wing& wing : wings) surfaces.join(wing.face, wings.front().face);
      continue;
    }
    const Vec3 edge = (mesh.vertices[ends.second] - mesh.vertices[ends.first]).stableNormalized();
    for (const Wing& wing : wings) {
      if (!wing.forwards) continue;
      const Vec3 own = inwards(mesh, edge, wing);
      const auto angle = [&](const Wing& other) {
        return other.forwards ? std::numeric_limits<double>::infinity()
                              : angle_through_solid(edge, inwards(mesh, edge, other), own);
      };
      surfaces.join(wing.face, std::ranges::min(wings, {}, angle).face);
    }
  }
  return surfaces;
}

}  // namespace

void merge_equal_vertices(PolygonMesh* mesh) {
  std::map<std::array<double, 3>, int> first;
  std::vector<Vec3> kept;
  std::vector<int> new_id;
  for (const Vec3& v : mesh->vertices) {
    const auto [it, is_new] =
        first.try_emplace({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}, static_cast<int>(kept.size()));
    if (is_new) kept.push_back(v);
    new_id.push_back(it->second);
  }
  for (auto& face : mesh->faces)
    for (int& v : face) v = new_id[v];
  mesh->vertices = std::move(kept);
}

std::vector<RawBlock> split_components(PolygonMesh mesh, const std::string& path) {
  if (mesh.faces.empty()) throw InputError(FileLocation{path}, "no faces in this file");
  if (is_open(mesh)) merge_equal_vertices(&mesh);
  DisjointSets surfaces = surfaces_of(mesh);
  const std::string stem = std::filesystem::path(path).stem().string();
  std::map<int, size_t> block_of_root;
  std::vector<RawBlock> blocks;
  std::vector<std::map<int, int>> local;  // per block: of the vertices of the file
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [it, is_new] = block_of_root.try_emplace(surfaces.root(static_cast<int>(f)), blocks.size());
    if (is_new) {
      blocks.push_back({stem, {path, 0, 0}, {}, {}, false, {}});
      local.emplace_back();
    }
    PolygonMesh& part = blocks[it->second].mesh;
    part.faces.emplace_back();
    for (int v : mesh.faces[f]) {
      const auto [id, is_first] = local[it->second].try_emplace(v, static_cast<int>(part.vertices.size()));
      if (is_first) part.vertices.push_back(mesh.vertices[v]);
      part.faces.back().push_back(id->second);
    }
  }
  if (blocks.size() > 1)
    for (size_t b = 0; b < blocks.size(); ++b) blocks[b].name = fmt::format("{}_{}", stem, b);
  return blocks;
}

}  // namespace cupola
