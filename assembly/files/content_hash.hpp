#pragma once

#include <string>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Hash of all data that later stages depend on (vertices, faces, parts, blocks, ties), as 32 hex digits.
std::string content_hash(const Assembly& assembly);

}  // namespace cupola
