#pragma once

#include <string>

#include "assembly/case/case_node.hpp"

namespace cupola {

/// Parses YAML text into a tree; the only user of yaml-cpp. `file` is the name for messages. Throws
/// InputError with line and column for invalid YAML and for what is not allowed in a case: duplicate keys,
/// anchors, aliases and tags, a second document, tabs as indentation, control characters, text that is not
/// UTF-8, more than 1 MiB, nesting deeper than 32.
CaseNode parse_yaml(const std::string& text, const std::string& file);

}  // namespace cupola
