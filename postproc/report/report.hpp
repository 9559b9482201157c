#pragma once

#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/gnuplot.hpp"
#include "postproc/pictures/paraview_views.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// What a report is made of besides the evaluation.
struct ReportInput {
  const Evaluation* evaluation = nullptr;
  std::vector<Table> tables;
  std::vector<Figure> figures;
  std::vector<Picture> pictures;  ///< of ParaView
  std::string figure_folder;      ///< where the figures' files are
  std::string run_yaml;           ///< the options in force, "" where they cannot be read
};

/// report.html: one file with everything inside, in the order verdict, quality, model, geometry check,
/// pictures, figures, tables, files, how it was run. Warnings come first.
std::string report_html(const ReportInput& input);

/// Verdict and quality in words, each with its numbers.
std::string verdict_text(const Summary& summary);
std::string quality_text(const Summary& summary);

}  // namespace cupola
