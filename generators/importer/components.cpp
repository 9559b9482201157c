#include <array>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "assembly/base/disjoint_sets.hpp"
#include "generators/importer/readers.hpp"

namespace cupola {

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

std::vector<RawBlock> split_components(const PolygonMesh& mesh, const std::string& path) {
  if (mesh.faces.empty()) throw InputError(FileLocation{path}, "no faces in this file");
  DisjointSets components(mesh.vertices.size());
  for (const auto& face : mesh.faces)
    for (int v : face) components.join(v, face[0]);

  const std::string stem = std::filesystem::path(path).stem().string();
  std::map<int, size_t> block_of_root;
  std::vector<RawBlock> blocks;
  std::vector<int> local(mesh.vertices.size(), -1);
  for (const auto& face : mesh.faces) {
    const auto [it, is_new] = block_of_root.try_emplace(components.root(face[0]), blocks.size());
    if (is_new) blocks.push_back({stem, {path, 0, 0}, {}, {}, false, {}});
    PolygonMesh& part = blocks[it->second].mesh;
    part.faces.emplace_back();
    for (int v : face) {
      if (local[v] < 0) {
        local[v] = static_cast<int>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[v]);
      }
      part.faces.back().push_back(local[v]);
    }
  }
  if (blocks.size() > 1)
    for (size_t b = 0; b < blocks.size(); ++b) blocks[b].name = fmt::format("{}_{}", stem, b);
  return blocks;
}

}  // namespace cupola
