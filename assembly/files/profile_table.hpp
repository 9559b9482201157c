#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace cupola {

/// The two inner control points of a cubic curve, (r, z) in m.
struct CurveControls {
  Eigen::Vector2d first = Eigen::Vector2d::Zero(), second = Eigen::Vector2d::Zero();
};

/// The points of a drawn section, from the springing upwards.
struct ProfileTable {
  std::vector<double> r, z;  ///< m
  std::vector<double>
      radius;  ///< m, of the arc to the next point, positive where it turns towards r = 0; 0: a straight line
  std::vector<std::optional<CurveControls>>
      curves;  ///< instead of a line or arc to the next point; empty: none
};

/// Reads two or three columns of numbers, r, z and radius (separated by commas, blanks or tabs; `#` starts a
/// comment, and a first row of words is a heading with these names, perhaps with units). Throws InputError
/// with file and line.
ProfileTable read_profile_table(const std::string& path);

/// Scales a section so that its first point, which has r > 0, has r = span / 2.
void scale_to_span(double span, ProfileTable* table);

}  // namespace cupola
