#pragma once

#include <string>
#include <vector>

#include "assembly/case/sweep.hpp"
#include "assembly/program/program.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// One line per member, NAME CASE key.path=value ..., in the format of cases/variants.txt.
std::string members_text(const std::vector<SweepMember>& members, const std::string& case_name);

/// One row per member: settings, status, residual, displacement, critical value and time, and minimum, chosen value and
/// maximum of each range of a range analysis. A member without
/// results has the status `missing` and a remark that says how far it got.
Table sweep_table(const std::vector<SweptKey>& sweep, const std::vector<SweepMember>& members,
                  const std::string& runs_folder);

/// Number of members with the status `missing`.
int num_missing(const Table& table);

/// The command line: cupola-post sweep CASE.yaml --members FILE | --runs FOLDER [--output FOLDER]
///
/// With --members it lists the runs of the case's `sweep`; with --runs it tabulates the finished ones. The
/// exit code is `failed` if members are missing.
ExitCode run_sweep(int argc, const char* const* argv);

}  // namespace cupola
