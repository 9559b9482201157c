#pragma once

#include <string>
#include <utility>
#include <vector>

namespace cupola {

/// Names the tests of a parameterised suite, in the order of its values: the last argument of
/// INSTANTIATE_TEST_SUITE_P.
inline auto test_names(std::vector<std::string> names) {
  return [names = std::move(names)](const auto& param_info) { return names.at(param_info.index); };
}

}  // namespace cupola
