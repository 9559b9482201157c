#pragma once

#include <string>
#include <string_view>

namespace cupola {

/// Start of the appended data as VTK writes it. With expat 2.6, and Debian 12's updates of expat 2.5,
/// ParaView 5.11 cannot read files with this tag: it passes the end of the element to expat in pieces, and
/// expat postpones a token that has not doubled in length since it was last tried (libexpat issue 840).
constexpr std::string_view kAppendedByVtk = "<AppendedData encoding=\"base64\">\n   _";
/// The same without the attribute, whose default is base64: short enough to be parsed at once. Of equal
/// length, so that it is replaced in place.
constexpr std::string_view kAppended = "<AppendedData>                  \n   _";
static_assert(kAppended.size() == kAppendedByVtk.size());

/// Replaces the first of these tags in the file by the second. Throws SystemError that names the file.
void shorten_appended_tag(const std::string& path);

/// Checks the layout of a VTK XML file written by Cupola (zlib, appended base64 data, 64-bit headers).
/// Returns the defect found, or an empty text if VTK may safely read the file. VTK trusts its input: an array
/// without a type aborts the process, and memory is allocated as declared before the data are read, so that a
/// few bytes could request petabytes. Every element must therefore stand where our writer puts it, with the
/// attributes that it writes, and must not declare more data than zlib can compress into the file (ratio
/// 1,032 at most).
std::string layout_defect(std::string_view text);

}  // namespace cupola
