#pragma once

#include <string>

#include "assembly/base/error.hpp"

namespace cupola {

/// Prefix of the cases that come with Cupola: `extends: cupola:dome_circular`.
inline constexpr const char* kBundledPrefix = "cupola:";

/// Folder of the bundled cases: the environment variable CUPOLA_CASES, else ../share/cupola/cases or
/// ../../cases beside the program (installed, or in a build tree). "" if there is none.
std::string bundled_folder();

/// File of a bundled case, given with the prefix. Throws InputError at `where` for a name that is not a plain
/// word or that no case has, with the nearest one.
std::string bundled_case(const std::string& name, const FileLocation& where);

/// True if a file lies in the folder of the bundled cases.
bool is_bundled(const std::string& file);

}  // namespace cupola
