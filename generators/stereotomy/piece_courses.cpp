#include "generators/stereotomy/piece_courses.hpp"

#include <algorithm>
#include <limits>

namespace cupola {

std::pair<int, int> courses_of(const Assembly& assembly, const ConvexPiece& piece, const Part& part,
                               const Block& laid, const BedUnder& bed_under, double near) {
  if (!bed_under || laid.num_rings == 1) return {part.ring, part.ring};
  constexpr double kFar = std::numeric_limits<double>::infinity();  // m
  int first = laid.ring, last = laid.ring + laid.num_rings - 1;
  for (int ring = first + 1; ring < laid.ring + laid.num_rings; ++ring) {
    const Plane bed = bed_under(part, ring);
    double low = kFar, high = -kFar;  // m, of the piece over the bed
    for (const ConvexPiece::Face& face : piece.faces)
      for (const int v : face.vertices) {
        const double height = bed.normal.dot(assembly.vertices[v]) - bed.offset;
        low = std::min(low, height);
        high = std::max(high, height);
      }
    if (low > -near) first = ring;
    if (high < near) last = std::min(last, ring - 1);
  }
  return {first, std::max(first, last)};
}

}  // namespace cupola
