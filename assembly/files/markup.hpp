#pragma once

#include <string>

namespace cupola {

/// Text made safe between tags and inside quoted attributes of XML and HTML.
std::string markup_text(const std::string& text);

}  // namespace cupola
