#pragma once

#include <string>
#include <vector>

#include "assembly/program/program.hpp"

namespace cupola {

/// Compares folders of `cupola-post analyse`: comparison.html with a reading made from the numbers, the
/// table (also comparison.csv), overlaid graphs and the runs' own figures side by side.
ExitCode compare(const std::vector<std::string>& post_folders, const std::string& output_folder, bool quiet);

/// The command line: cupola-post compare post/A post/B ... --output FOLDER
ExitCode run_compare(int argc, const char* const* argv);

}  // namespace cupola
