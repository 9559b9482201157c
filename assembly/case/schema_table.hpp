#pragma once

#include <string>
#include <vector>

namespace cupola {

/// One key of the case file, as `--schema` shows it.
struct SchemaRow {
  std::string path;       ///< e.g. joints.friction
  std::string condition;  ///< e.g. "type: wall"; "" for always
  std::string type;       ///< number, integer, text, one of the names, list, map
  std::string unit;
  std::string range;
  std::string default_value;
  std::string meaning;
};

struct SchemaTable {
  std::vector<SchemaRow> rows;
  std::string condition;  ///< of the rows that are added next
};

/// The table in Markdown with aligned columns, so that a terminal and a web page both show it.
std::string to_markdown(const SchemaTable& table);

}  // namespace cupola
