#pragma once

#include <functional>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// The abscissa of a closed surface, near `guess`, at which a line round its axis has an azimuth (rad): the
/// guess itself if its point has that azimuth but for rounding. `point`: of the line, at an abscissa.
double abscissa_at(const std::function<Vec3(double abscissa)>& point, double azimuth, double guess);

}  // namespace cupola
