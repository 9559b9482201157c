#pragma once

#include <string>

namespace cupola {

/// Escapes text for use between tags and in quoted attributes of XML and HTML.
std::string markup_text(const std::string& text);

}  // namespace cupola
