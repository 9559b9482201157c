#include "solver/dynamics/scene_options.hpp"

namespace cupola {

DetectionOptions detection_options(const Case& scene) {
  DetectionOptions options;
  options.points =
      scene.joints.compliance.per == Compliance::Per::area ? PatchPoints::quadrature : PatchPoints::corners;
  return options;
}

ContactSolverOptions contact_solver_options(const Analysis& analysis) {
  ContactSolverOptions options;
  options.tolerance = analysis.tolerance;
  options.method = analysis.method;
  options.law = analysis.friction_law;
  return options;
}

}  // namespace cupola
