#pragma once

#include <string>
#include <utility>
#include <vector>

namespace cupola::verification {

/// One reference value: the parameters of the problem and the value or interval expected.
struct ReferenceRow {
  std::vector<std::pair<std::string, std::string>> parameters;  ///< name and text, in the order of the file
  std::string expected_text;
  double low = 0.0, high = 0.0;  ///< equal for a single value
  bool slow = false;             ///< takes more than a few seconds
  std::string why;               ///< explanation of a row that fails; "" if none

  double expected() const { return 0.5 * (low + high); }
  bool is_interval() const { return low != high; }
  bool has(const std::string& parameter) const;
  /// Throw InputError if there is no such parameter.
  std::string text(const std::string& parameter) const;
  double number(const std::string& parameter) const;
  int integer(const std::string& parameter) const;
  /// The parameters in words, e.g. "voussoirs 27, t/R 0.15"; "" without parameters.
  std::string name() const;
};

/// One verification problem. The fields are those of references.yaml, which explains them.
struct Reference {
  std::string id, chapter, group, title, statement, quantity, source, error, reason;
  double tolerance = 0.0;
  std::vector<ReferenceRow> rows;
};

/// All problems of references.yaml in the order of the file.
const std::vector<Reference>& references();
/// Throws InputError if there is no such problem.
const Reference& reference(const std::string& id);

/// A list of manual_text.yaml, `other_tests` or `not_verified`: topic and text of each item.
std::vector<std::pair<std::string, std::string>> manual_text(const std::string& list);

}  // namespace cupola::verification
