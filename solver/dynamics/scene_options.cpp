#include "solver/dynamics/scene_options.hpp"

#include "assembly/base/error.hpp"

namespace cupola {

DetectionOptions detection_options(const Case& scene) {
  DetectionOptions options;
  options.points =
      scene.joints.compliance.per == Compliance::Per::area ? PatchPoints::quadrature : PatchPoints::corners;
  options.margin = scene.contact.margin;
  options.contact_file = scene.contact.file;
  options.plane = scene.analysis.plane;
  if (!options.contact_file.empty() && scene.analysis.type != AnalysisType::static_)
    throw InputError(FileLocation{scene.file},
                     "contact.method file: contacts from a file serve a static analysis only");
  if (scene.contact.method == ContactDetection::Method::perturbed_gjk) {
    const ContactDetection::Perturbation& gjk = scene.contact.perturbation;
    options.perturbed_gjk = {scene.contact.margin, gjk.perturbations, gjk.angle,
                             static_cast<std::uint64_t>(gjk.seed), gjk.keep};
  }
  return options;
}

ContactSolverOptions contact_solver_options(const Analysis& analysis) {
  ContactSolverOptions options;
  options.tolerance = analysis.tolerance;
  options.method = analysis.method;
  options.law = analysis.friction_law;
  options.max_iterations = analysis.max_iterations;
  options.lag_factor = analysis.type == AnalysisType::dynamic;  // from step to step little changes
  return options;
}

}  // namespace cupola
