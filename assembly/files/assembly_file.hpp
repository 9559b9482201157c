#pragma once

#include <string>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Writes assembly.vtu: one cell per convex part, blocks in the field data. FORMAT.md tells the arrays.
/// `options`: those in force when it was made, as text; nothing reads them but people.
void write_assembly(const std::string& path, const Assembly& assembly, const std::string& options = "");

/// Reads and checks it: closed index ranges, finite coordinates, known format version, content hash.
/// Throws InputError with the path.
Assembly read_assembly(const std::string& path);

}  // namespace cupola
