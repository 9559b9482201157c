#pragma once

#include <string>
#include <vector>

#include "assembly/case/section.hpp"
#include "postproc/studies/study_page.hpp"
#include "postproc/tables/run_files.hpp"

namespace cupola {

/// Which runs answer which question on the first screen of a study's page. Each run is read as its report
/// reads: post/answers.json.
struct StudyAnswers {
  std::string verdict;               ///< the run that says whether it stands; "": the study gives no answers
  std::string thrust;                ///< the run with the range of the thrust; "": that of the verdict
  std::vector<std::string> margins;  ///< runs whose margins are sorted, least first
  std::vector<std::string> causes;   ///< runs that change what the model is built on: settlements
};
void declare_answers(Section& s, StudyAnswers& answers);

/// A run, or a group of runs, that was not computed, and why.
struct NotComputed {
  std::string what, why;
};

/// What a run that failed wrote as its error, in out/RUN/errors.txt; "" if it wrote none.
std::string error_of_run(const std::string& runs_folder, const std::string& run);

/// Adds the first screen of the page: verdict, least margin, thrust, worst cause, then all margins with what
/// decides each, and what was not computed. Returns the same as text.
std::string add_answers(const StudyAnswers& answers, const std::vector<NotComputed>& not_computed,
                        const std::string& runs_folder, RunCache& runs, StudyPage* page);

}  // namespace cupola
