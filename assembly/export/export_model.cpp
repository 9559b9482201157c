#include "assembly/export/export_model.hpp"

#include <algorithm>
#include <map>

#include "assembly/base/disjoint_sets.hpp"
#include "assembly/export/block_union.hpp"

namespace cupola {
namespace {

/// True if every edge joins two faces, which run along it in opposite directions, and all faces hang together
/// by their edges. The parts of generated blocks share vertices, and all faces between them are `internal`;
/// those of cut and of imported blocks may meet in other faces, or along a part of a face, and the two arms
/// of a stone of a groin vault have vertices of their own.
bool is_one_surface(const BlockSurface& surface) {
  std::map<std::pair<int, int>, int> face_along;  // an edge, in one direction
  for (size_t f = 0; f < surface.faces.size(); ++f) {
    const std::vector<int>& face = surface.faces[f];
    for (size_t i = 0; i < face.size(); ++i)
      if (!face_along.try_emplace({face[i], face[(i + 1) % face.size()]}, f).second) return false;
  }
  DisjointSets joined(surface.faces.size());
  for (const auto& [edge, face] : face_along) {
    const auto other = face_along.find({edge.second, edge.first});
    if (other == face_along.end()) return false;
    joined.join(face, other->second);
  }
  for (size_t f = 0; f < surface.faces.size(); ++f)
    if (joined.root(static_cast<int>(f)) != 0) return false;
  return true;
}

/// Number of a vertex within `distance` of a point, which is added if there is none.
int vertex_at(const Vec3& p, double distance, std::vector<Vec3>* vertices) {
  for (size_t i = 0; i < vertices->size(); ++i)
    if (((*vertices)[i] - p).norm() <= distance) return static_cast<int>(i);
  vertices->push_back(p);
  return static_cast<int>(vertices->size()) - 1;
}

BlockSurface united_surface(const ExportModel& model, const std::vector<int>& parts) {
  const Assembly& assembly = model.assembly;
  std::vector<PlanePolygon> faces;
  double size = 0.0;
  for (const int p : parts) {
    const Part& part = assembly.parts[p];
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      std::vector<Vec3> corners = face_points(assembly, f);
      for (Vec3& corner : corners) corner = model.placed(part.block, corner);
      faces.emplace_back(std::move(corners));
      for (const Vec3& corner : faces.back().corners)
        size = std::max(size, (corner - faces[0].corners[0]).norm());
    }
  }
  constexpr double kSamePoint = 1e-8;  // of the size, ten times the tolerance of union_faces()
  BlockSurface surface;
  for (const std::vector<Vec3>& polygon : union_faces(faces)) {
    std::vector<int>& face = surface.faces.emplace_back();
    for (const Vec3& p : polygon) face.push_back(vertex_at(p, kSamePoint * size, &surface.vertices));
  }
  return surface;
}

}  // namespace

std::vector<BlockSurface> block_surfaces(const ExportModel& model) {
  const Assembly& assembly = model.assembly;
  std::vector<BlockSurface> surfaces(assembly.blocks.size());
  std::vector<std::map<int, int>> own_vertex(assembly.blocks.size());
  std::vector<std::vector<int>> parts_of(assembly.blocks.size());
  for (size_t p = 0; p < assembly.parts.size(); ++p) {
    const Part& part = assembly.parts[p];
    BlockSurface& surface = surfaces[part.block];
    parts_of[part.block].push_back(static_cast<int>(p));
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (assembly.face_kinds[f] == FaceKind::internal) continue;
      std::vector<int>& face = surface.faces.emplace_back();
      for (const int v : assembly.face(f)) {
        const auto [known, is_new] =
            own_vertex[part.block].try_emplace(v, static_cast<int>(surface.vertices.size()));
        if (is_new) surface.vertices.push_back(model.placed(part.block, assembly.vertices[v]));
        face.push_back(known->second);
      }
    }
  }
  for (size_t b = 0; b < surfaces.size(); ++b)
    if (parts_of[b].size() > 1 && !is_one_surface(surfaces[b]))
      surfaces[b] = united_surface(model, parts_of[b]);
  return surfaces;
}

}  // namespace cupola
