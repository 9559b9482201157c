#pragma once

#include "assembly/model/assembly.hpp"

namespace cupola {

/// The assembly with its thickness multiplied by `factor`. Every edge from the intrados to the extrados is
/// scaled about its midpoint, so that the middle surface and the planes of bed and head joints do not move.
/// Throws InputError if no edge connects an intrados with an extrados, as in walls and imported blocks, or if
/// a vertex has two such edges, or one of a free block none.
Assembly with_thickness(const Assembly& assembly, double factor);

}  // namespace cupola
