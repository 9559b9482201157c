#pragma once

#include "assembly/model/assembly.hpp"

namespace cupola {

/// The assembly with its thickness multiplied by `factor`. Every edge from the intrados to the extrados is
/// scaled about its midpoint, so that the middle surface and the planes of bed and head joints do not move.
/// Throws InputError if no edge connects an intrados with an extrados, as in walls and imported blocks, or if
/// a vertex has two such edges, or one of a free block none.
Assembly with_thickness(const Assembly& assembly, double factor);

/// The largest factor at which all stones are sound, and the first block that would not be.
struct ThicknessLimit {
  double factor;  ///< infinity: none
  int block;
};

/// Beyond it an edge of a skin turns back: beds meet inside the shell, or the intrados reaches the axis.
/// Throws InputError as with_thickness().
ThicknessLimit largest_thickness(const Assembly& assembly);

}  // namespace cupola
