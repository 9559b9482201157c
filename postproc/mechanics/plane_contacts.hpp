#pragma once

#include "assembly/model/results.hpp"

namespace cupola {

/// The contacts of a run in the plane y = constant (analysis.plane), as those of the same run in space. Each
/// point stands for a line across the joint: two points at its ends take half its force and area each. The
/// width of a joint is its area over its length in the plane. A joint of a single point stays as it is.
void spread_across_plane(ContactTable* contacts);

}  // namespace cupola
