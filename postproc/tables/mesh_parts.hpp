#pragma once

#include <cstdint>
#include <vector>

#include "assembly/files/mesh_file.hpp"
#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

// What the writers of mesh files share.

using MeshInts = std::vector<std::int32_t>;
using MeshDoubles = std::vector<double>;

int add_point(Mesh* mesh, const Vec3& p);
void append(const Vec3& v, MeshDoubles* values);

/// Field data that say what a file is of; `scale` is that of its segments, 0 without any.
std::vector<MeshArray> about(const Evaluation& evaluation, double scale);

/// The scale of all segments of a run, m per N.
double common_scale(const Evaluation& evaluation);

}  // namespace cupola
