#include "generators/surface/surface_map.hpp"

#include "assembly/base/error.hpp"

namespace cupola {

double SurfaceMap::depth(double bed, int layer) const {
  CUPOLA_ASSERT(layer >= 0 && layer <= num_wythes());
  double sum = 0.0, above_springing = 0.0;
  bool is_known = false;
  for (int w = 0; w < layer; ++w) {
    if (!wythes[w].constant() && !is_known) {
      above_springing = height(bed);
      is_known = true;
    }
    sum += wythes[w].at(above_springing);
  }
  return sum;
}

}  // namespace cupola
