#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace cupola {

/// Admissible range and unit of a number.
struct NumberRule {
  std::string_view unit = "-";
  double min = -std::numeric_limits<double>::infinity();    ///< smallest admitted
  double above = -std::numeric_limits<double>::infinity();  ///< the value must be greater
  double max = std::numeric_limits<double>::infinity();     ///< largest admitted
  double below = std::numeric_limits<double>::infinity();   ///< the value must be less
};

bool admits(const NumberRule& rule, double value);
std::string describe_range(const NumberRule& rule);  ///< ">= 0", "> 0 and < 90", or "finite"

/// Strict readers: the whole text must be the value. They return "" or the rule that the text breaks.
/// Refused: nan, inf, numbers beyond double precision (1e400), hexadecimal, 1_000, and yes for true.
std::string read_number(std::string_view text, double* value);
std::string read_integer(std::string_view text, int* value);
std::string read_flag(std::string_view text, bool* value);

/// The shortest decimal that reads back to the same double.
std::string format_number(double value);

/// A force with five digits, in kN, or in MN from a thousand kN: "163.42 MN".
std::string readable_force(double newtons);

}  // namespace cupola
