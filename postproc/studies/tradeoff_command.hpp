#pragma once

#include "assembly/program/program.hpp"

namespace cupola {

/// The command line: cupola-post tradeoff STUDY.txt ... --runs FOLDER --output FOLDER
///
/// Compares the runs of a study with their references, writes tradeoff.csv, tradeoff.html and figures/, and
/// prints the text.
ExitCode run_tradeoff(int argc, const char* const* argv);

}  // namespace cupola
