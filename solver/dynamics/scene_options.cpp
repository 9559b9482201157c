#include "solver/dynamics/scene_options.hpp"

#include <string>
#include <utility>

#include "assembly/base/error.hpp"
#include "assembly/case/case_times.hpp"

namespace cupola {
namespace {

void require_second_order(const Case& scene, const Model& model) {
  const auto refuse = [](const std::string& what) {
    throw InputError("analysis.integrator: generalized_alpha is not available with " + what + "; use euler");
  };
  if (!model.ties.empty()) refuse("ties");
  if (scene.supports.moving()) refuse("moving supports");
  if (model.joints.has_strength()) refuse("joints of strength");
  if (scene.analysis.sleep) refuse("analysis.sleep");
}

}  // namespace

DetectionOptions detection_options(const Case& scene) {
  DetectionOptions options;
  options.sampling.points =
      scene.joints.compliance.per == Compliance::Per::area ? PatchPoints::quadrature : PatchPoints::corners;
  options.sampling.subdivide = scene.contact.subdivide;
  options.margin = scene.contact.margin;
  options.contact_file = scene.contact.file;
  options.ignore_initial_gaps = scene.contact.initial_gaps == ContactDetection::InitialGaps::ignore;
  options.plane = scene.analysis.plane;
  if (!options.contact_file.empty() && scene.analysis.type != AnalysisType::static_)
    throw InputError("contact.method: file requires analysis.type: static");
  if (scene.contact.method == ContactDetection::Method::perturbed_gjk) {
    const ContactDetection::Perturbation& gjk = scene.contact.perturbation;
    options.perturbed_gjk = {scene.contact.margin, gjk.perturbations, gjk.angle,
                             static_cast<std::uint64_t>(gjk.seed), gjk.keep};
  }
  return options;
}

FlowRule flow_rule(const Analysis& analysis) {
  return analysis.dilatancy ? FlowRule(*analysis.dilatancy) : FlowRule(analysis.friction_law);
}

ContactSolverOptions contact_solver_options(const Analysis& analysis) {
  ContactSolverOptions options;
  options.tolerance = analysis.tolerance;
  options.method = analysis.method;
  options.law = flow_rule(analysis);
  options.max_iterations = analysis.iteration_limit();
  return options;
}

SimulationOptions simulation_options(const Case& scene) {
  const Analysis& analysis = scene.analysis;
  SimulationOptions options;
  options.step.h = analysis.time_step;
  options.step.integrator = Integrator::of(analysis.integrator);
  options.step.damping = analysis.damping;
  options.step.recovery_speed = analysis.recovery_speed;
  options.step.recovery = analysis.recovery;
  options.step.tangential = analysis.tangential;
  options.adaptive = analysis.adaptive;
  options.sleep = analysis.sleep;
  options.static_start = starts_static(scene);
  options.detection = detection_options(scene);
  options.solve = contact_solver_options(analysis);
  options.solve.lag_factor = true;  // the problem changes little from step to step
  options.solve.try_rest = true;
  return options;
}

Simulation make_simulation(const Case& scene, const Assembly& assembly) {
  Model model = make_model(scene, assembly);
  if (scene.analysis.sleep) require_sleepable(scene, model);
  if (scene.analysis.integrator == TimeIntegrator::generalized_alpha) require_second_order(scene, model);
  return {std::move(model), simulation_options(scene)};
}

}  // namespace cupola
