#pragma once

#include <string>
#include <vector>

namespace cupola {

/// A place at which a crack was looked for on the building.
struct SeenCrack {
  double azimuth = 0.0;  ///< deg, about the z axis
  double width = 0.0;    ///< m, >= 0; 0: none was seen
};

/// Reads a CSV file with the columns azimuth_deg and width_m, among others: azimuths that increase within one
/// turn, and a crack at one place or more. Throws InputError with file, line and column.
std::vector<SeenCrack> read_seen_cracks(const std::string& path);

}  // namespace cupola
