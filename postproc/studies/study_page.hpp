#pragma once

#include <string>
#include <vector>

#include "postproc/figures/gnuplot.hpp"
#include "postproc/studies/study_run.hpp"
#include "postproc/tables/table.hpp"
#include "postproc/tables/written_files.hpp"

namespace cupola {

/// The page of a study, study.html, written part by part; and the CSV files and figures beside it.
class StudyPage {
 public:
  /// Creates the folder, or removes what the page before wrote there.
  StudyPage(std::string title, std::string folder);

  void add(const std::string& html) { body_ += html; }
  void add_paragraph(const std::string& text);
  /// Draws the figures into figures/ and embeds them, each below its title. What could not be drawn becomes a
  /// warning.
  void add_figures(const std::vector<Figure>& figures);
  /// Writes NAME.csv and shows the table without columns in which all cells are empty.
  void add_table(const Table& table);
  /// The same; the page shows `shown` in its place.
  void add_table(const Table& table, const Table& shown);
  /// Links to the reports of the runs that have one.
  void add_report_links(const std::vector<StudyRun>& runs, const std::string& runs_folder);
  void write_csv(const Table& table) const;  ///< NAME.csv, and NAME.tex for LaTeX
  void write() const;                        ///< study.html
  const std::string& folder() const { return folder_; }

 private:
  std::string title_, folder_, body_;
  WrittenFiles written_;
};

/// The table as text, each column as wide as its widest cell.
std::string aligned_text(const Table& table);

}  // namespace cupola
