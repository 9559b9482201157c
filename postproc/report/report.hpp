#pragma once

#include <optional>
#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/report/stages.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// Contents of a report.
struct ReportInput {
  const Evaluation* evaluation = nullptr;
  std::string tables;                       ///< tables_html()
  std::optional<StageReport> construction;  ///< of a staged run
  std::vector<HistoryRow> history;          ///< of a dynamic run
  std::string viewer;                       ///< the 3-D view, as HTML; may be empty
  std::vector<Figure> figures;
  std::string figure_folder;   ///< folder of the figure files
  std::string picture_folder;  ///< of the standard views; "" if none were drawn
  std::string run_yaml;        ///< text of run.yaml; "" if it cannot be read
};

/// The tables as the report shows them: long ones as links to their CSV files. `equilibrium`: whether what
/// interprets forces is shown.
std::string tables_html(const std::vector<Table>& tables, bool equilibrium);

/// report.html as one self-contained file: first_screen(), ranges of a range analysis, findings, figures,
/// tables, solution quality, case, files and run information, in this order. A run that found no equilibrium
/// has the motion in place of the findings, and no certificate.
std::string report_html(const ReportInput& input);

/// What the forces of an equilibrium show, one sentence with its number per item.
std::vector<std::string> finding_sentences(const Evaluation& evaluation);

/// The verdict and the solution quality in words, each with its numbers.
std::string verdict_text(const Summary& summary, FrameRole shown);  ///< `shown`: of the frame evaluated
/// "no equilibrium exists" if that is proven, otherwise "no equilibrium was found". A motion seeks none: it is
/// in motion at its end, or comes to rest after its collapse.
std::string lack_of_equilibrium(const Summary& summary, FrameRole shown);
std::vector<std::string> quality_sentences(const Evaluation& evaluation);

/// True if the two ends of the bracket of a critical value differ in the digits that the report prints.
bool shows_bracket(const CriticalValue& critical);

}  // namespace cupola
