#pragma once

#include <string>
#include <vector>

#include "assembly/case/case_node.hpp"

namespace cupola {

/// Reads a case file, merged over the files that it extends, and applies every `--set key.path=value`. The
/// name in `extends: other.yaml` is relative to the file that contains it; `extends: cupola:NAME` is a
/// bundled case. A `sweep` or `ensemble` is not inherited: members are run where their file says so. `files`
/// and `warnings`, if given, receive the paths of the files read and what was not inherited.
CaseNode load_case_tree(const std::string& path, const std::vector<std::string>& set_options,
                        std::vector<std::string>* files = nullptr,
                        std::vector<std::string>* warnings = nullptr);

/// The path of a file named in an input file `from_file`, relative to that file. Throws InputError at `where`
/// unless it lies in or below `root_folder` after resolving every `..` and symbolic link: a case from someone
/// else must not read other files of the machine.
std::string path_inside(const std::string& root_folder, const std::string& from_file, const std::string& name,
                        const FileLocation& where);

}  // namespace cupola
