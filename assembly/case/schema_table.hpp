#pragma once

#include <string>
#include <vector>

namespace cupola {

/// One key of the case file, as shown by `--schema`.
struct SchemaRow {
  std::string path;       ///< e.g. joints.friction
  std::string condition;  ///< e.g. "type: wall"; "" if the key is always valid
  std::string type;       ///< number, integer, text, the admissible names, list or map
  std::string unit;
  std::string range;
  std::string default_value;
  std::string meaning;
};

struct SchemaTable {
  std::vector<SchemaRow> rows;
  std::string condition;  ///< of the rows added next
};

/// The table in Markdown with aligned columns, readable on a terminal and on a web page.
std::string to_markdown(const SchemaTable& table);

}  // namespace cupola
