#pragma once

#include <functional>
#include <utility>

#include "generators/stereotomy/convex_clip.hpp"

namespace cupola {

/// The plane of the bed under a course at a part as laid; its normal points to this course.
using BedUnder = std::function<Plane(const Part& part, int ring)>;

/// The first and the last course that a piece of a part occupies, whose block as laid has the courses of
/// `laid`. A piece that ends within `near` (m) of a bed ends there. Without `bed_under` each part lies in one
/// course.
std::pair<int, int> courses_of(const Assembly& assembly, const ConvexPiece& piece, const Part& part,
                               const Block& laid, const BedUnder& bed_under, double near);

}  // namespace cupola
