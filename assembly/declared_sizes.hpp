#pragma once

#include <string>
#include <string_view>

namespace cupola {

/// What is wrong with the sizes that a VTK XML file of ours (zlib, appended base64 data, headers of 64 bits)
/// declares; empty when it may be read. VTK takes memory as the file says before it looks at the data: a few
/// bytes could ask for petabytes. zlib packs 1,032 bytes into one at most.
std::string oversized(std::string_view text);

}  // namespace cupola
