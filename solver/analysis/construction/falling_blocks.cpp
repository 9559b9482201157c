#include "solver/analysis/construction/falling_blocks.hpp"

#include <algorithm>

namespace cupola {
namespace {

/// m, largest distance of a vertex from the centroid.
std::vector<double> block_radii(const Assembly& assembly) {
  std::vector<double> radius(assembly.blocks.size(), 0.0);
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const int vertex : assembly.face(f)) {
        double& r = radius[part.block];
        r = std::max(r, (assembly.vertices[vertex] - assembly.blocks[part.block].centroid).norm());
      }
  return radius;
}

}  // namespace

std::vector<FallingBlock> falling_blocks(const Model& model, const VecX& v) {
  constexpr double kSlow = 0.1;  // of the fastest: carried along, or settling
  const double fastest = largest_speed(v);
  std::vector<FallingBlock> falling;
  if (fastest == 0.0) return falling;
  const std::vector<double> radius = block_radii(*model.assembly);
  for (int i = 0; i < model.num_free(); ++i) {
    const double speed = v.segment<3>(6 * i).norm(), turn = v.segment<3>(6 * i + 3).norm();
    if (speed < kSlow * fastest) continue;
    const int block = model.free_blocks[i];
    falling.push_back(
        {block, turn * radius[block] >= speed ? FallingMode::tips : FallingMode::slides, speed / fastest});
  }
  return falling;
}

}  // namespace cupola
