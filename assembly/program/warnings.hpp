#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace cupola {

/// All warnings of several lists, each once, in their order.
std::vector<std::string> united(std::initializer_list<std::vector<std::string>> lists);

/// Prints warnings on stderr, one line each and at most ten, without those that an earlier program of the
/// chain has printed. `strict` (--strict): prints all and throws InputError if there is one.
void report_warnings(std::string_view program, const std::vector<std::string>& warnings,
                     const std::vector<std::string>& printed_before, bool strict);

}  // namespace cupola
