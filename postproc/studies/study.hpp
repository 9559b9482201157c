#pragma once

#include <string>
#include <vector>

#include "assembly/case/sweep.hpp"
#include "postproc/claims/claim.hpp"
#include "postproc/studies/study_answers.hpp"
#include "postproc/studies/study_table.hpp"
#include "postproc/studies/tradeoff_runs.hpp"

namespace cupola {

/// Finished runs side by side: comparison.html and comparison.csv.
struct Comparison {
  std::string name;  ///< subfolder of the study's folder; empty: the folder itself
  std::vector<std::string> runs;
};

/// A study: runs, the numbers taken from them, and what is made of the numbers. It is a YAML file
/// cases/studies/NAME.yaml (docs/cases.md describes its keys), or a case with a `sweep` or `ensemble`, which
/// is the short form of a study of that case.
struct Study {
  std::string name;  ///< of the file without ending; runs that the study defines are in the folder NAME/
  std::string title;
  std::string script;  ///< in tests/benchmark: prints the rows of the tables without columns
  std::vector<StudyRun>
      runs;  ///< in the order of the file; tables have one row for each unless they say otherwise
  std::vector<StudyTable> tables;
  std::vector<Comparison> comparisons;
  std::vector<TradeoffRun> tradeoff;
  std::vector<Claim> claims;
  std::vector<ClaimFigure> figures;
  std::vector<SweptKey> sweep;  ///< of a case
  std::vector<SampledRuns> ensembles;
  StudyAnswers answers;
  std::vector<NotComputed> left_out;  ///< groups of runs that do not apply to the case
};

/// The case of a study that is made for any case: {case} in its file.
struct CaseOfStudy {
  std::string name;      ///< or the path of its file, NAME.yaml
  std::string assembly;  ///< file with its blocks, for groups with `settle`; empty: they are left out
};

/// Reads a study with the strict reader of case files; throws InputError with line and key. `of`, if not
/// empty, replaces the key `case` of a trade-off; in other studies it stands for {case}, and the study is
/// named CASE_STUDY.
Study read_study(const std::string& path, const CaseOfStudy& of = {});

/// Every run that the study reads, each once: those that it defines first.
std::vector<StudyRun> members_of(const Study& study);

/// Throws InputError for a member that is neither a case nor a variant of the folder of `path`, or above it
/// if that is studies/, nor, if a folder of runs is given, a run in it; and for a member of a sweep that has
/// the name, and so the folder, of a case or variant.
void require_known(const std::vector<StudyRun>& members, const std::string& path,
                   const std::string& runs_folder = "");

/// One line per run: NAME for a run that exists as case or variant, NAME CASE key.path=value ... for the
/// others, in the format of cases/variants.txt. Throws like require_known().
std::string members_text(const std::vector<StudyRun>& members, const std::string& path);

}  // namespace cupola
