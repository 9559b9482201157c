#pragma once

#include <string>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Writes assembly.vtu: one cell per convex part, blocks in the field data. FORMAT.md lists the
/// arrays. `options`: the case in force, as YAML; for information only.
void write_assembly(const std::string& path, const Assembly& assembly, const std::string& options = "");

/// Reads an assembly and checks it: index ranges, finite coordinates, format version, content hash. Throws
/// InputError with the path.
Assembly read_assembly(const std::string& path);

}  // namespace cupola
