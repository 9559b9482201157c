// Files of imported blocks, as bytes; the build defines the reader (read_obj, read_off ...). Promise: every
// corner of an accepted block is finite and every face refers to corners of its own block.

#include "generators/importer/readers.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace cupola {
namespace {

void check(const RawBlock& block) {
  for (const Vec3& vertex : block.mesh.vertices) demand(vertex.allFinite(), "corners are finite");
  for (const auto& part : block.point_parts)
    for (const Vec3& point : part) demand(point.allFinite(), "corners of parts are finite");
  demand(block.mesh.faces.empty() != block.point_parts.empty(), "a block has faces or parts");
  for (const auto& face : block.mesh.faces) {
    demand(face.size() >= 3, "faces are polygons");
    for (const int vertex : face)
      demand(vertex >= 0 && vertex < static_cast<int>(block.mesh.vertices.size()), "faces name corners");
  }
  demand(!block.density || *block.density > 0.0, "densities are positive");
}

}  // namespace

bool reader_accepts(std::string_view bytes) {
  static const ScratchPath scratch("_blocks");
  const std::string& path = scratch.path;
  write_bytes(path, bytes);
  std::vector<RawBlock> blocks;
  if (!accepts([&] { blocks = CUPOLA_FUZZED_READER(path); })) return false;
  for (const RawBlock& block : blocks) check(block);
  return true;
}

}  // namespace cupola
