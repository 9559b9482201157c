#pragma once

#include <string>
#include <vector>

#include "assembly/program/program.hpp"

namespace cupola {

/// Compares output folders of `cupola-post analyse`. Writes comparison.html with the linked 3-D views of the
/// runs, findings in words, a table, graphs and maps side by side, and comparison.csv with the table.
ExitCode compare(const std::vector<std::string>& post_folders, const std::string& output_folder, bool quiet);

/// The command line: cupola-post compare post/A post/B ... --output FOLDER
ExitCode run_compare(int argc, const char* const* argv);

}  // namespace cupola
