#pragma once

#include <vector>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// A parallel projection: the unit vectors that point right and up on the page, and towards the reader.
struct Projection {
  Vec3 right, up, towards;
  std::vector<double> row(const Vec3& x) const { return {right.dot(x), up.dot(x)}; }
};

/// A vault about the z axis and imported blocks are seen obliquely from above, arches and walls in elevation.
Projection projection_of(const Evaluation& evaluation);

}  // namespace cupola
