#pragma once

#include "assembly/files/mesh_file.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Adds one cell per part, with the vertex ids of the assembly: a hexahedron if the faces of the part are six
/// quadrilaterals that form one (VTK draws and measures it exactly), else a polyhedron given by its faces.
void add_part_cells(const Assembly& assembly, Mesh* mesh);

}  // namespace cupola
