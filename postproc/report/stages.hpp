#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/gnuplot.hpp"
#include "postproc/report/key_number.hpp"
#include "postproc/tables/csv_file.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// What a staged run shows of its stages.
struct StageReport {
  Table table;                   ///< one row per stage
  std::optional<Figure> figure;  ///< what fresh mortar must provide; none if that was not searched
  int standing = 0;              ///< stages
  std::string worst;  ///< the first stage that does not stand, else the most demanding; "" for neither
  std::vector<KeyNumber> largest;  ///< of all stages that stand: by the names of the numbers of the last one
};

/// What the joints of a stage that stands bear at most.
struct StagePeaks {
  double pressure = 0.0;                                           ///< Pa
  double strength_use = std::numeric_limits<double>::quiet_NaN();  ///< NaN without strength
  double widest_gap = 0.0;                                         ///< m, of a crack; 0: none
};
StagePeaks peaks_of(const FrameEvaluation& stage);

/// The columns of its table. `least`: the property of the fresh mortar that was sought.
std::vector<Table::Column> construction_columns(StagedConstruction::Least least);

/// Of results/construction.csv, with what moves (results/failures.csv; none if nothing does) and the heights
/// of the rings. `peaks`: by stage, of those that stand and have a frame.
StageReport report_stages(const Evaluation& evaluation, StagedConstruction::Least least,
                          const CsvFile& stages, const std::optional<CsvFile>& failures,
                          const std::map<int, StagePeaks>& peaks = {});

/// stages.csv of versions up to 0.3, in which the friction of fresh mortar was sought, as construction.csv.
CsvFile from_stages_csv(CsvFile old);

}  // namespace cupola
