#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "assembly/base/error.hpp"

namespace cupola {

/// The arguments of a program without options: `fewest` to `most`. InputError with the usage otherwise, so
/// that --help does not start hours of measurements.
inline std::vector<std::string> read_arguments(int argc, char** argv, size_t fewest, size_t most,
                                               const std::string& usage) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < fewest || arguments.size() > most ||
      std::ranges::any_of(arguments, [](const std::string& text) { return text.starts_with('-'); }))
    throw InputError("usage: " + usage);
  return arguments;
}

}  // namespace cupola
