#pragma once

#include "assembly/model/time_function.hpp"

namespace cupola {

/// Motion through the points of a table, not empty, by a cubic spline: at rest before the first and after the
/// last, and where the value stays, over three points or an interval twice as long as those beside it.
DisplacementInTime interpolate_smoothly(const TableInTime& displacement);

}  // namespace cupola
