#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace cupola {

/// Which numbers a key admits, and in which unit.
struct NumberRule {
  std::string_view unit = "-";
  double min = -std::numeric_limits<double>::infinity();    ///< smallest admitted
  double above = -std::numeric_limits<double>::infinity();  ///< the value must be greater
  double max = std::numeric_limits<double>::infinity();     ///< largest admitted
  double below = std::numeric_limits<double>::infinity();   ///< the value must be less
};

bool admits(const NumberRule& rule, double value);
std::string describe_range(const NumberRule& rule);  ///< ">= 0", "> 0 and < 90", or "finite"

/// Strict decimal readers: the whole text is the number. They return "" or the rule that the text breaks.
/// Not admitted: nan, inf, what a double cannot hold (1e400), hexadecimal, 1_000, yes for true.
std::string read_number(std::string_view text, double* value);
std::string read_integer(std::string_view text, int* value);
std::string read_flag(std::string_view text, bool* value);

/// The shortest decimal that reads back to the same double.
std::string format_number(double value);

}  // namespace cupola
