#pragma once

#include <string>
#include <string_view>

namespace cupola {

/// What is wrong with the layout of a VTK XML file of ours (zlib, appended base64 data, headers of 64 bits);
/// empty when VTK may read it. VTK trusts a file: an array without a type ends the process, and memory is
/// taken as declared before the data are looked at, so that a few bytes could ask for petabytes. Every
/// element must stand where our writer puts it, with the attributes that it writes, and declare no more than
/// zlib can have packed into the file: 1,032 bytes in one.
std::string layout_defect(std::string_view text);

}  // namespace cupola
