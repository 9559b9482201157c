#pragma once

#include <string>

#include "assembly/model/results.hpp"

namespace cupola {

/// Content of summary.json, and the summary read from it. `file` is the name for messages; throws InputError
/// that names the file and the key.
std::string to_json(const Summary& summary);
Summary summary_from_json(const std::string& text, const std::string& file);

/// Content of interrupted.json.
std::string to_json(const Interruption& interruption);

}  // namespace cupola
