#pragma once

#include <string>
#include <vector>

#include "assembly/case/case_node.hpp"

namespace cupola {

/// The file's tree with everything it extends below it and every `--set key.path=value` on top.
/// `extends: other.yaml` is relative to the file that says it.
CaseNode load_case_tree(const std::string& path, const std::vector<std::string>& set_options);

/// The path of a file that an input names, relative to `from_file`. Refused with InputError at `where`
/// unless it lies in or below `root_folder` after every `..` and symbolic link is followed: a case that
/// somebody sent must not read the rest of the machine.
std::string path_inside(const std::string& root_folder, const std::string& from_file, const std::string& name,
                        const FileLocation& where);

}  // namespace cupola
