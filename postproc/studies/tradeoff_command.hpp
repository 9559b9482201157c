#pragma once

#include "assembly/program/program.hpp"

namespace cupola {

/// The command line: cupola-post tradeoff STUDY.txt ... --runs FOLDER --output FOLDER
///
/// Writes tradeoff.csv, figures/ and tradeoff.html, and prints the text.
ExitCode run_tradeoff(int argc, const char* const* argv);

}  // namespace cupola
