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

/// For a terminal of 120 columns: a line with key, type, unit, range and default, and below it the meaning.
std::string to_text(const SchemaTable& table);

}  // namespace cupola
