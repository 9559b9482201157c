#pragma once

#include <optional>
#include <string>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/gnuplot.hpp"
#include "postproc/tables/csv_file.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// What a staged run shows of its stages.
struct StageReport {
  Table table;  ///< one row per stage
  std::optional<Figure>
      figure;         ///< what fresh mortar must provide; none if no stage needs it, or none was searched
  int standing = 0;   ///< stages
  std::string worst;  ///< the first stage that does not stand, else the most demanding; "" for neither
};

/// Of rings laid one by one from unloaded joints (results/stages.csv), with the heights of the rings.
StageReport rings_laid(const Evaluation& evaluation, const CsvFile& stages);

/// Of any other construction (results/construction.csv), with what moves (results/failures.csv; none if
/// nothing does). `least`: the property of the fresh mortar that was sought.
StageReport blocks_laid(StagedConstruction::Least least, const CsvFile& stages,
                        const std::optional<CsvFile>& failures);

}  // namespace cupola
