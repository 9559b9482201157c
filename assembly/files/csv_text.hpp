#pragma once

#include <string>

namespace cupola {

/// A cell of a CSV file, in quotes if it holds commas, quotes or line ends. A text that a spreadsheet would
/// run as a formula, because it begins with = + - or @ and is no number, gets an apostrophe in front, which
/// marks it as text.
std::string csv_text(const std::string& text);

/// The text of a cell without its quotes, and without the apostrophe that csv_text() adds.
std::string text_of_csv(const std::string& cell);

}  // namespace cupola
