#pragma once

#include <string>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/plot_style.hpp"

namespace cupola {

/// What a thrust figure shows of the wythes: named data blocks, and elements of plot commands that use them.
/// All are empty if the meridian has no thrust lines of wythes.
struct WytheCurves {
  std::string data;
  std::string section;  ///< the blocks cut by the plane of the meridian, with a comma behind
  std::string lines;    ///< their thrust lines in the profile; here and below with a comma in front
  std::string resultant, couple, distance;  ///< over the height
};
WytheCurves wythe_curves(const Evaluation& evaluation, const MeridianEvaluation& meridian,
                         const ForceUnit& unit);

/// Abscissa of a profile: horizontal distance from the axis in the plane of the meridian; its own x for an
/// arch.
double profile_abscissa(const ThrustLine& line, const Vec3& point);

}  // namespace cupola
