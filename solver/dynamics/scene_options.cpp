#include "solver/dynamics/scene_options.hpp"

namespace cupola {

DetectionOptions detection_options(const Case& scene) {
  DetectionOptions options;
  options.points =
      scene.joints.compliance.per == Compliance::Per::area ? PatchPoints::quadrature : PatchPoints::corners;
  return options;
}

}  // namespace cupola
