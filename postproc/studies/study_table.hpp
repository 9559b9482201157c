#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assembly/case/section.hpp"
#include "postproc/claims/quantity.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// A text of the run of a row.
enum class RunText : std::uint8_t { run, status, message, verdict };
constexpr auto enum_names(RunText) {
  return std::array{"run", "status", "message", "verdict"};
}

/// A column of a table. Its cells are either given (`texts`), or a text of the run (`text`), or the cells of
/// a column of the table that gives the rows (`cell`), or numbers: scale * (value / over - minus). In the
/// names of runs, {run} stands for the run of the row.
struct StudyColumn {
  std::string heading;
  std::vector<std::string> texts;  ///< one per row
  std::optional<RunText> text;
  std::string cell;
  Quantity value;
  std::optional<Quantity> over, minus;
  double scale = 1.0;  ///< from SI to the unit of the heading; -1 changes the sign
  int digits = 0;      ///< significant digits of the page; 0: those of the table
  /// Cell of a run that lacks the number; {reason}: what its search found instead, else its message.
  /// Without it such a run is an error.
  std::optional<std::string> absent;
};

/// A table with one row per run, or per row of a CSV file of one run.
struct StudyTable {
  std::string name;               ///< of its CSV file, and of its place on the page
  std::string page;               ///< of the documentation; empty: none
  int digits = 3;                 ///< significant digits on the page
  std::vector<std::string> runs;  ///< empty: all runs of the study
  std::string rows;               ///< CSV file of post/ that gives the rows; empty: one row per run
  bool transposed = false;        ///< columns become rows; the first one becomes the header
  std::vector<StudyColumn> columns;
};
void declare_study_table(Section& s, StudyTable& table);

/// The runs that a table reads, each row's after the other.
std::vector<std::string> runs_of(const StudyTable& table);

/// The table with all digits, for CSV. A cell whose run is missing reads `not run`, of a run that did not
/// reach its accuracy `unconverged`.
Table measured_table(const StudyTable& table, RunCache& cache);

/// The rows that a script printed, instead of columns.
Table printed_table(const StudyTable& table, const std::string& csv_path);

/// As Markdown, with the digits of the columns, and transposed if the table is.
std::string to_markdown(const StudyTable& table, const Table& measured);

}  // namespace cupola
