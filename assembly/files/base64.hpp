#pragma once

#include <string>

namespace cupola {

/// Bytes as base64 with padding (RFC 4648, section 4), for data inside HTML.
std::string base64(const std::string& bytes);

}  // namespace cupola
