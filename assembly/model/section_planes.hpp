#pragma once

#include <string>

#include <Eigen/Core>

namespace cupola {

/// Half-plane of a meridian, at an azimuth from x towards y; walls have no meridians.
struct Meridian {
  std::string name;
  double azimuth_deg = 0.0;
};

/// A plane given by a point and a normal of any length. Blocks on the side to which the normal points lie
/// beyond it.
struct CutPlane {
  std::string name;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d normal{1.0, 0.0, 0.0};
};

}  // namespace cupola
