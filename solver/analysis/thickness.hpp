#pragma once

#include "assembly/model/assembly.hpp"

namespace cupola {

/// The assembly with its masonry `factor` times as thick: every edge from the intrados to the extrados is
/// stretched about its middle, so that middle surface, beds and head joints stay in their places. Throws
/// InputError when no edge leads from an intrados to an extrados, as in walls and imported blocks, or when
/// one vertex has two such edges.
Assembly with_thickness(const Assembly& assembly, double factor);

}  // namespace cupola
