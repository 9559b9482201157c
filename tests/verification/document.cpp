#include "tests/verification/document.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "postproc/report/html.hpp"

namespace cupola::verification {
void Document::heading(int level, const std::string& text) {
  html_ += fmt::format("<h{0}>{1}</h{0}>\n", level, html_text(text));
  markdown_ += fmt::format("{}{} {}\n\n", markdown_.empty() ? "" : "\n", std::string(level, '#'), text);
}

void Document::paragraph(const std::string& text) {
  html_ += "<p>" + html_text(text) + "</p>\n";
  constexpr std::size_t kColumns = 118;
  std::size_t column = 0;
  std::istringstream words(text);
  for (std::string word, more; words >> word;) {
    while (std::ranges::count(word, '`') % 2 == 1 && words >> more) word += ' ' + more;  // code stays whole
    // At the start of a line, a sign would make a list.
    const bool is_sign = word == "-" || word == "+" || word == "*";
    if (column > 0 && column + word.size() >= kColumns && !is_sign) {
      markdown_ += '\n';
      column = 0;
    } else if (column > 0) {
      markdown_ += ' ';
      ++column;
    }
    markdown_ += word;
    column += word.size();
  }
  markdown_ += "\n\n";
}

void Document::table(const Table& table) {
  html_ += html_table(table);
  std::string rule = "|";
  for (const Table::Column& column : table.columns) {
    markdown_ += "| " + column.meaning + " ";
    rule += "---|";
  }
  markdown_ += "|\n" + rule + "\n";
  for (const auto& row : table.rows) {
    for (const Table::Cell& cell : row) markdown_ += "| " + to_display(cell) + " ";
    markdown_ += "|\n";
  }
  markdown_ += "\n";
}

std::string Document::html(const std::string& title) const {
  return html_page(title, html_);
}

}  // namespace cupola::verification
