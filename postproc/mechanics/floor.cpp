#include "postproc/mechanics/floor.hpp"

#include <algorithm>
#include <limits>

#include "assembly/model/results.hpp"

namespace cupola {

Floor floor_of(double largest, double unbalanced, double block_size) {
  Floor floor;
  floor.force = std::max(kNegligibleShare * largest, unbalanced);
  floor.share = largest > 0.0 ? std::min(1.0, floor.force / largest) : kNegligibleShare;
  floor.length = floor.share * block_size;
  return floor;
}

double couple_length(const Wrench& wrench, const Floor& floor) {
  if (floor.hides(wrench.force)) return std::numeric_limits<double>::quiet_NaN();
  return above(central_axis(wrench).couple_length, floor.length);
}

}  // namespace cupola
