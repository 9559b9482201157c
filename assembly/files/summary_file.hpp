#pragma once

#include <string>

#include "assembly/model/results.hpp"

namespace cupola {

std::string to_json(const Summary& summary);
Summary summary_from_json(const std::string& text, const std::string& file);

}  // namespace cupola
