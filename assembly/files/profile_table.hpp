#pragma once

#include <string>
#include <vector>

namespace cupola {

/// The points of a drawn section, from the springing upwards.
struct ProfileTable {
  std::vector<double> r, z;    ///< m
  std::vector<double> radius;  ///< m, of the arc to the next point; 0: a straight line
};

/// Reads two or three columns of numbers, r, z and radius (separated by commas, blanks or tabs; `#` starts a comment, and a first row
/// of words is a heading). Throws InputError with file and line.
ProfileTable read_profile_table(const std::string& path);

}  // namespace cupola
