#pragma once

#include <string>
#include <vector>

#include "assembly/case/sweep.hpp"
#include "assembly/program/program.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// One line per member, NAME CASE key.path=value ..., as in cases/variants.txt.
std::string members_text(const std::vector<SweepMember>& members, const std::string& case_name);

/// One row per member: what was set, how it ended, residual, displacement, limit, time. A member without
/// results has the status `missing` and says in words how far it came.
Table sweep_table(const std::vector<SweptKey>& sweep, const std::vector<SweepMember>& members,
                  const std::string& runs_folder);

/// How many members are missing.
int num_missing(const Table& table);

/// `cupola-post sweep CASE.yaml --members FILE` lists the runs of a case's `sweep`; with --runs and --output
/// it tabulates those that are finished. Ends with `failed` when members are missing.
ExitCode run_sweep(int argc, const char* const* argv);

}  // namespace cupola
