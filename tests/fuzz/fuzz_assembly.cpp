// assembly.vtu with a valid checksum and corrupted content. Promise: in an accepted assembly every index is
// in range and every coordinate is finite.

#include "assembly/files/assembly_file.hpp"
#include "tests/fuzz/mesh_edits.hpp"
#include "tests/fuzz/small_model.hpp"

namespace cupola {
namespace {

void check(const Assembly& assembly) {
  const int num_blocks = static_cast<int>(assembly.blocks.size());
  const int num_vertices = static_cast<int>(assembly.vertices.size());
  for (const Vec3& vertex : assembly.vertices) demand(vertex.allFinite(), "vertices are finite");
  for (const Part& part : assembly.parts) {
    demand(part.block >= 0 && part.block < num_blocks, "parts name blocks");
    demand(part.face_start >= 0 && part.num_faces >= 4 &&
               part.face_start + part.num_faces <= assembly.num_faces(),
           "parts name faces");
  }
  for (int f = 0; f < assembly.num_faces(); ++f) {
    demand(assembly.face(f).size() >= 3, "faces are polygons");
    for (const int vertex : assembly.face(f))
      demand(vertex >= 0 && vertex < num_vertices, "faces name vertices");
  }
  for (const Block& block : assembly.blocks)
    demand(block.mass > 0.0 && block.centroid.allFinite() && block.inertia.allFinite(), "blocks have mass");
}

}  // namespace

bool reader_accepts(std::string_view bytes) {
  static const ScratchPath scratch(".vtu");
  const std::string& path = scratch.path;
  static const Mesh good = [&] {
    write_assembly(path, small_assembly());
    return read_mesh(path);
  }();
  Mesh mesh = good;
  edit_mesh(ByteSource(bytes), &mesh);
  write_mesh(path, mesh);
  Assembly assembly;
  if (!accepts([&] { assembly = read_assembly(path); })) return false;
  check(assembly);
  return true;
}

}  // namespace cupola
