#include "assembly/files/part_cells.hpp"

#include <array>
#include <optional>
#include <vector>

namespace cupola {
namespace {

/// The vertices of a part in the order of a VTK hexahedron, if its six faces are quadrilaterals that form
/// one: those of the first face seen from inside, then the vertex across from each of them.
std::optional<std::array<int, 8>> hexahedron_corners(const Assembly& assembly, const Part& part) {
  if (part.num_faces != 6) return std::nullopt;
  for (int f = part.face_start; f < part.face_start + 6; ++f)
    if (assembly.face(f).size() != 4) return std::nullopt;
  const auto bottom = assembly.face(part.face_start);
  std::array<int, 8> corners{bottom[0], bottom[3], bottom[2], bottom[1], -1, -1, -1, -1};
  const auto index_in_bottom = [&corners](int vertex) {
    for (int i = 0; i < 4; ++i)
      if (corners[i] == vertex) return i;
    return -1;
  };
  int num_side_edges = 0;
  for (int f = part.face_start + 1; f < part.face_start + 6; ++f) {
    const auto face = assembly.face(f);
    for (int i = 0; i < 4; ++i) {
      const int a = index_in_bottom(face[i]);
      if (a < 0 || index_in_bottom(face[(i + 1) % 4]) >= 0) continue;
      if (corners[4 + a] != -1) return std::nullopt;
      corners[4 + a] = face[(i + 1) % 4];
      ++num_side_edges;
    }
  }
  if (num_side_edges != 4) return std::nullopt;
  for (int i = 4; i < 8; ++i)
    for (int j = i + 1; j < 8; ++j)
      if (corners[i] == corners[j]) return std::nullopt;
  return corners;
}

}  // namespace

void add_part_cells(const Assembly& assembly, Mesh* mesh) {
  std::vector<int> faces;
  mesh->cell_points.reserve(assembly.face_vertices.size() + assembly.face_kinds.size() +
                            assembly.parts.size());
  for (const Part& part : assembly.parts) {
    if (const auto corners = hexahedron_corners(assembly, part)) {
      mesh->add_cell(Mesh::CellType::hexahedron, *corners);
      continue;
    }
    faces.assign(1, part.num_faces);
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const auto face = assembly.face(f);
      faces.push_back(static_cast<int>(face.size()));
      faces.insert(faces.end(), face.begin(), face.end());
    }
    mesh->add_cell(Mesh::CellType::polyhedron, faces);
  }
}

}  // namespace cupola
