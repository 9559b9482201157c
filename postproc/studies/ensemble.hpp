#pragma once

#include <string>
#include <vector>

#include "postproc/studies/study_page.hpp"
#include "postproc/studies/study_run.hpp"

namespace cupola {

/// Adds ensembles to a page: how many members fall, statistics of every result that varies, what the inputs
/// explain, and, between ensembles of the same samples, differences member by member. Tables: NAME.csv with a
/// row per member, NAME_statistics, NAME_inputs, NAME_ends, NAME_bands_TABLE; `differences` of the page.
/// Returns the same as text.
std::string add_ensembles(const std::vector<SampledRuns>& ensembles, const std::string& runs_folder,
                          StudyPage* page);

}  // namespace cupola
