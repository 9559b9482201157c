#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/case/ensemble.hpp"
#include "assembly/case/section.hpp"

namespace cupola {

/// A run of a study.
struct StudyRun {
  std::string name;                   ///< folder below the folder of all runs
  std::string case_name;              ///< empty: the run is a case or variant of this name
  std::vector<std::string> settings;  ///< key.path=value, or --option of cupola-solve; --tables: no figures;
                                      ///< --keep=summary or tables: the files that stay
};

/// Members of one case with values drawn from distributions or read from a file.
struct SampledRuns {
  std::string name;  ///< of its tables
  Samples samples;
  std::optional<Ensemble::Design> design;  ///< nothing: read from a file
  std::vector<StudyRun> runs;              ///< one per row of the samples
};

/// The members NAME_0001 ... of a case or, if `prefix` ends in a slash, in a folder of their own.
std::vector<StudyRun> sampled_runs(const Samples& samples, KeptFiles keep, const std::string& prefix,
                                   const std::string& case_name, const std::vector<std::string>& settings);

/// Runs given together: those that exist as cases or variants, or every case with every combination of
/// values.
struct RunGroup {
  std::vector<std::string> names;  ///< of existing runs
  std::vector<std::string> cases, settings;
  std::string name = "{case}";  ///< of a run; {case} stands for its case; swept keys are appended
  std::vector<SweptKey> sweep;
  std::optional<Ensemble> ensemble;  ///< random members of every case, the same for all
  std::vector<std::string> needs;    ///< keys of which the case must give one; else the group is left out
  double settle = 0.0;  ///< one run per support, which sinks by this share of the span; 0: no such runs
};
void declare_run_group(Section& s, RunGroup& group);

/// The runs of a group; those that the study defines are in the folder `study`.
std::vector<StudyRun> runs_of(const RunGroup& group, const std::string& study);

/// The ensembles of a group, one per case; none without `ensemble`.
std::vector<SampledRuns> ensembles_of(const RunGroup& group, const std::string& study);

/// True for letters, digits and . _ + -, of which names of runs, tables and cases consist: make and a shell
/// read them.
bool is_plain_name(const std::string& name);

/// Reads settings separated by spaces. A shell reads them, too: only letters, digits and . _ + - = [ ] , :
/// are accepted.
void declare_settings(Section& s, std::vector<std::string>& settings, const std::string& meaning);

/// Reads names separated by spaces, each of which must be plain; {run} and {case} are left for later.
void declare_names(Section& s, const std::string& key, std::vector<std::string>& names,
                   const std::string& meaning);

/// `text` with every `placeholder` replaced.
std::string filled(std::string text, const std::string& placeholder, const std::string& value);

}  // namespace cupola
