#pragma once

#include <cstdio>
#include <string>

namespace cupola {

/// True if the stream is a terminal.
bool is_terminal(std::FILE* stream);

enum class Colour { red, green, yellow };

/// `text` in colour if the stream is a terminal and the environment does not set NO_COLOR (no-color.org),
/// else unchanged.
std::string in_colour(const std::string& text, Colour colour, std::FILE* stream);

}  // namespace cupola
