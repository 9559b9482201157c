#include "postproc/mechanics/block_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "assembly/model/block_distance.hpp"

namespace cupola {

bool is_divided(const Assembly& assembly, int block) {
  const int first = assembly.blocks[block].ring;
  return std::ranges::any_of(parts_of_block(assembly, block), [&](const Part& p) { return p.ring != first; });
}

int ring_of_piece(const Assembly& assembly, int block, const Vec3& point, int at_most) {
  constexpr double kNear = 1e-3;  // of the size of a block: contact points lie in the gap of a joint
  const Block& own = assembly.blocks[block];
  if (own.num_rings == 1) return own.ring;
  if (!is_divided(assembly, block)) return own.ring + own.num_rings - 1;
  const std::span<const Part> parts = parts_of_block(assembly, block);
  std::vector<double> distances;
  for (const Part& part : parts) distances.push_back(distance_from_part(assembly, part, point));
  const double near = std::ranges::min(distances) + kNear * std::cbrt(own.volume);
  int highest = -1, lowest = std::numeric_limits<int>::max();
  for (size_t i = 0; i < parts.size(); ++i) {
    if (distances[i] > near) continue;
    lowest = std::min(lowest, parts[i].ring);
    if (parts[i].ring <= at_most) highest = std::max(highest, parts[i].ring);
  }
  return highest < 0 ? lowest : highest;
}

}  // namespace cupola
