#pragma once

#include <utility>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Which sides of its course the bed faces of a part lie on. The parts that mate with a face decide: the shape
/// of a course, as of an apse or of a wall under a raking top, leads astray.
class BedSides {
 public:
  BedSides(const Assembly& assembly, int num_rings);

  /// -1: towards the course below; 1: towards the one above; 0: across the course, as between slices.
  int side_of(const Part& part, int face) const;

  /// (num_rings), unit direction from ring to ring: upwards in a vault or wall, along the axis of an arch.
  const std::vector<Vec3>& progress() const { return progress_; }

 private:
  int mated_side(const Part& part, int face) const;

  const Assembly& assembly_;
  std::vector<std::pair<int, int>>
      rings_;  ///< per vertex, lowest and highest course of the parts that have it
  std::vector<Vec3> progress_;
};

}  // namespace cupola
