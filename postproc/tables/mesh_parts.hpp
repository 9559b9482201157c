#pragma once

#include <cstdint>
#include <vector>

#include "assembly/files/mesh_file.hpp"
#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

// Helpers of the functions that write mesh files.

using MeshInts = std::vector<std::int32_t>;
using MeshDoubles = std::vector<double>;

/// Returns the index of the new point.
int add_point(Mesh* mesh, const Vec3& p);
/// Appends the three components.
void append(const Vec3& v, MeshDoubles* values);

/// Field data that describe the run. `scale` is the scale of the segments, 0 for a file without segments.
std::vector<MeshArray> about(const Evaluation& evaluation, double scale);

/// Scale of all segments of a run, m per N.
double common_scale(const Evaluation& evaluation);

}  // namespace cupola
