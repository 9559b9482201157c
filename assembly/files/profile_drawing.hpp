#pragma once

#include "assembly/files/profile_table.hpp"

namespace cupola {

/// True for the name of an SVG file.
bool is_drawing(const std::string& path);

/// Reads a section from an SVG file with one path: lines, arcs and curves, with their transforms. The path is
/// the half from the springing to the crown, which lies on the axis, or the whole section between two
/// springings of equal height, whose halves must be equal. It is scaled to the span (m) at the springing.
/// Circular arcs stay arcs; elliptic ones become cubic curves over at most an eighth of a right angle, which
/// deviate by less than 1e-8 of their size.
///
/// Throws InputError with the file and line for a file that is no drawing, for other numbers of paths, closed
/// and broken paths, and unequal halves.
ProfileTable read_profile_drawing(const std::string& path, double span);

}  // namespace cupola
