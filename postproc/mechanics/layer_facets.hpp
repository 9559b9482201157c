#pragma once

#include <array>
#include <map>
#include <vector>

#include "postproc/mechanics/shell.hpp"

namespace cupola {

/// The bed facets of a shell with wythes, by the layers on which their corners lie. A cell whose bed consists
/// of two triangles, because it is cut into convex parts, makes one facet.
class LayerFacets {
 public:
  explicit LayerFacets(const Assembly& assembly) : assembly_(assembly) {}

  /// Adds face `f` of a part to a bed. An internal face counts only if it lies on the bed below its part.
  void add(const Part& part, int f, int bed);
  void add_to(Shell* shell) const;

 private:
  struct Cell {
    std::vector<int> corners;    // vertices
    Vec3 normal = Vec3::Zero();  // m2, times its area
    bool internal = false;
  };
  const Assembly& assembly_;
  std::map<std::array<int, 4>, Cell> cells_;  // by bed, block, slice and wythe
};

/// Sets the wythes of all blocks, and the layers of all beds to unknown; without wythes to intrados and
/// extrados.
void set_wythes(const Assembly& assembly, Shell* shell);

}  // namespace cupola
