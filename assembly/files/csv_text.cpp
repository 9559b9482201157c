#include "assembly/files/csv_text.hpp"

#include <cstdlib>

namespace cupola {
namespace {

bool is_number(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0';
}

bool begins_a_formula(const std::string& text) {
  return !text.empty() && std::string("=+-@\t\r").find(text[0]) != std::string::npos && !is_number(text);
}

}  // namespace

std::string csv_text(const std::string& text) {
  const bool formula = begins_a_formula(text);
  if (!formula && text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = formula ? "\"'" : "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string text_of_csv(const std::string& cell) {
  return cell.starts_with('\'') && begins_a_formula(cell.substr(1)) ? cell.substr(1) : cell;
}

}  // namespace cupola
