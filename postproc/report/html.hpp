#pragma once

#include <string>

#include "assembly/files/markup.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// Escaped text of a page, not of an attribute, in which what stands between backticks is set as code.
std::string html_text(const std::string& text);

/// A link to report.html in the folder post/ of a run, from a page in another folder; the text alone if there
/// is none.
std::string report_link(const std::string& text, const std::string& post_folder,
                        const std::string& page_folder);

/// A picture as an <img> with the file embedded; "" if the file does not exist.
std::string html_picture(const std::string& path, const std::string& alternative);

/// A table that scrolls sideways in its own frame, with units below the headings and numbers as to_display.
std::string html_table(const Table& table);

/// A complete document around `body`, with one style for wide screens, narrow screens and print.
std::string html_page(const std::string& title, const std::string& body);

}  // namespace cupola
