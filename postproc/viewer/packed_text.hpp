#pragma once

#include <string>

namespace cupola {

/// Bytes in zlib's format (RFC 1950), which browsers inflate as "deflate". Throws SystemError if memory is
/// short.
std::string deflated(const std::string& bytes);

/// The same as text for HTML, in base64.
std::string packed_text(const std::string& bytes);

}  // namespace cupola
