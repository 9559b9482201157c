#include "assembly/files/number_text.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace cupola {

bool admits(const NumberRule& rule, double value) {
  return value >= rule.min && value > rule.above && value <= rule.max && value < rule.below;
}

std::string describe_range(const NumberRule& rule) {
  std::string out;
  const auto add = [&out](const char* relation, double bound) {
    if (!std::isfinite(bound)) return;
    out += fmt::format("{}{} {}", out.empty() ? "" : " and ", relation, format_number(bound));
  };
  add(">=", rule.min);
  add(">", rule.above);
  add("<=", rule.max);
  add("<", rule.below);
  return out.empty() ? "finite" : out;
}

std::string read_number(std::string_view text, double* value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range) return "exceeds the range of double precision";
  if (error != std::errc{} || end != text.data() + text.size()) return "must be a number";
  if (!std::isfinite(number)) return "must be a finite number";
  *value = number + 0.0;  // turns -0 into 0, so that equal values have equal hashes
  return {};
}

std::string read_integer(std::string_view text, int* value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range) return "is too large; whole numbers go up to 2147483647";
  if (error != std::errc{} || end != text.data() + text.size()) return "must be a whole number";
  *value = number;
  return {};
}

std::string read_flag(std::string_view text, bool* value) {
  if (text != "true" && text != "false") return "must be true or false";
  *value = text == "true";
  return {};
}

std::string format_number(double value) {
  // fmt writes 1e-08; we write 1e-8, as case files do.
  std::string text = fmt::format("{}", value);
  const size_t e = text.find('e');
  if (e == std::string::npos) return text;
  const size_t digits = text.find_first_of("+-", e) == e + 1 ? e + 2 : e + 1;
  while (text[digits] == '0' && digits + 1 < text.size()) text.erase(digits, 1);
  if (text[e + 1] == '+') text.erase(e + 1, 1);
  return text;
}

std::string readable_force(double newtons) {
  return std::abs(newtons) < 1e6 ? fmt::format("{:.5g} kN", 1e-3 * newtons)
                                 : fmt::format("{:.5g} MN", 1e-6 * newtons);
}

}  // namespace cupola
