#pragma once

#include <string>
#include <vector>

#include "assembly/case/sweep.hpp"
#include "postproc/studies/study_page.hpp"
#include "postproc/studies/study_run.hpp"

namespace cupola {

/// One row per member: settings, status, residual, displacement, critical value and time, and minimum, chosen value and
/// maximum of each range of a range analysis. A member without
/// results has the status `missing` and a remark that says how far it got.
Table sweep_table(const std::vector<SweptKey>& sweep, const std::vector<StudyRun>& members,
                  const std::string& runs_folder);

/// Adds a sweep to a page: how the members ended, a figure, the table (sweep.csv), and links to the reports of the
/// members. Returns the same as text.
std::string add_sweep(const std::vector<SweptKey>& sweep, const std::vector<StudyRun>& members,
                      const std::string& runs_folder, StudyPage* page);

}  // namespace cupola
