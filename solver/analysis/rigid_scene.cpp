#include "solver/analysis/rigid_scene.hpp"

#include "assembly/model/joint_rule.hpp"
#include "solver/collision/contact_detector.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

RigidScene rigid_scene(const Case& scene, std::shared_ptr<const Assembly> assembly) {
  RigidScene rigid;
  rigid.assembly = std::move(assembly);
  rigid.model = make_model(scene, *rigid.assembly);
  rigid.start = state_at_rest(rigid.model);
  ContactDetector detector(*rigid.assembly, detection_options(scene));
  rigid.contacts = detector.update(rigid.start.poses);
  const double open = joint_rule(smallest_block_size(*rigid.assembly), scene.contact.margin).min_width;
  std::erase_if(rigid.contacts.points, [&](const Contact& contact) { return contact.gap > open; });
  rigid.memories = match_memories({}, rigid.contacts.points);

  const StepOptions step{.h = 1.0, .time_advance = 0.0};
  ConicProblem& problem = rigid.problem;
  problem.contacts =
      build_step_problem(rigid.model, rigid.start, rigid.contacts, rigid.memories, step).problem;
  problem.load = applied_forces(rigid.model, rigid.start, rigid.start.time);
  problem.cost = VecX::Zero(3 * problem.contacts.num_contacts());
  problem.load_columns = MatX(problem.load.size(), 0);
  problem.rows = MatX(problem.cost.size(), 0);
  return rigid;
}

Equilibrium balance_of(const RigidScene& scene, const VecX& gamma) {
  return compute_equilibrium(scene.model, scene.start, scene.contacts,
                             joint_forces(scene.contacts, gamma, 1.0), scene.start.time);
}

}  // namespace cupola
