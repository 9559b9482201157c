#pragma once

#include <string>
#include <string_view>

namespace cupola {

/// Checks the layout of a VTK XML file written by Cupola (zlib, appended base64 data, 64-bit headers).
/// Returns the defect found, or an empty text if VTK may safely read the file. VTK trusts its input: an array
/// without a type aborts the process, and memory is allocated as declared before the data are read, so that a
/// few bytes could request petabytes. Every element must therefore stand where our writer puts it, with the
/// attributes that it writes, and must not declare more data than zlib can compress into the file (ratio
/// 1,032 at most).
std::string layout_defect(std::string_view text);

}  // namespace cupola
