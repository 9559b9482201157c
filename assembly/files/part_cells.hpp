#pragma once

#include "assembly/files/mesh_file.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Adds one cell per part, on the assembly's vertex ids: a hexahedron where the part's faces are six
/// quadrilaterals that make one (VTK measures and draws it exactly), else a polyhedron given by its faces.
void add_part_cells(const Assembly& assembly, Mesh* mesh);

}  // namespace cupola
