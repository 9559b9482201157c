#pragma once

#include <string>

#include "assembly/case/case_node.hpp"

namespace cupola {

/// What was probably meant by an unknown key, as the end of a message: keys of other sections with the same
/// or a related name ("; did you mean joints.friction?"), or a number with a decimal comma. "" if nothing is
/// near. `map` holds the key, `path` leads to it.
std::string suggestion_for(const CaseNode& map, const std::string& key, const std::string& path);

/// Hint for a text that should be a number: a decimal comma or a unit. "" if it has neither.
std::string number_hint(const std::string& text);

}  // namespace cupola
