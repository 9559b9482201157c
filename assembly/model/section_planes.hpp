#pragma once

#include <string>

#include <Eigen/Core>

namespace cupola {

/// A meridian is the half-plane at an azimuth; walls have none.
struct Meridian {
  std::string name;
  double azimuth_deg = 0.0;
};

/// Any plane, by a point and a normal of any length; the blocks that the normal points to lie beyond it.
struct CutPlane {
  std::string name;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d normal{1.0, 0.0, 0.0};
};

}  // namespace cupola
