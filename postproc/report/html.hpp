#pragma once

#include <string>

#include "assembly/files/markup.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// A picture as an <img> that needs no other file; "" when the file is not there.
std::string html_picture(const std::string& path, const std::string& alternative);

/// A table that scrolls sideways in its own frame; units under the headings, numbers as to_display.
std::string html_table(const Table& table);

/// The document around a body: charset, title, and the style for screen, small screen and paper.
std::string html_page(const std::string& title, const std::string& body);

}  // namespace cupola
