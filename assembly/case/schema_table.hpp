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
/// Where a section has the keys of an earlier one, only its name is written, with that of the earlier one.
std::string to_text(const SchemaTable& table);

/// A JSON schema of case files (draft 7), with which editors complete, explain and check keys. The keys of
/// all alternatives of a section are admitted together, and required keys are not demanded, because a case
/// may extend another.
std::string to_json_schema(const SchemaTable& table);

}  // namespace cupola
