#pragma once

#include "assembly/case/imported_blocks.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// True for an assembly of Cupola, .vtu, such as `cupola-post export` writes of the end of a path.
bool is_assembly_file(const ImportedBlocks& source);

/// Its blocks with their courses, supports, densities and ties. Throws InputError for keys that complete the
/// files of other programs.
Assembly import_assembly(const ImportedBlocks& source);

}  // namespace cupola
