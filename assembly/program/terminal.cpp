#include "assembly/program/terminal.hpp"

#include <cstdlib>

#include <unistd.h>

namespace cupola {

bool is_terminal(std::FILE* stream) {
  return ::isatty(::fileno(stream)) == 1;
}

std::string in_colour(const std::string& text, Colour colour, std::FILE* stream) {
  const char* no_colour = std::getenv("NO_COLOR");
  if (!is_terminal(stream) || (no_colour != nullptr && no_colour[0] != '\0')) return text;
  const char* code = colour == Colour::red ? "31" : colour == Colour::green ? "32" : "33";
  return std::string("\033[1;") + code + "m" + text + "\033[0m";
}

}  // namespace cupola
