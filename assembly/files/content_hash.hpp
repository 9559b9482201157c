#pragma once

#include <string>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Fingerprint of everything a later stage depends on (vertices, faces, blocks), as 32 hex digits.
std::string content_hash(const Assembly& assembly);

}  // namespace cupola
