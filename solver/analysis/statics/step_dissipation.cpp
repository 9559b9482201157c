#include "solver/analysis/statics/step_dissipation.hpp"

#include <cmath>

#include "solver/dynamics/energy_account.hpp"
#include "solver/dynamics/joint_damage.hpp"

namespace cupola {

void StepDissipation::include(const State& start, const ContactSet& contacts,
                              const StaticSolution& solution) {
  const StepProblem& step = solution.step;
  for (int i = 0; i < step.num_contacts; ++i) {
    Vec3 displacement = step.reach * inelastic_velocity(step.problem, i, solution.step_solution);
    const JointWork work = joint_work(step, i, solution.step_solution.gamma.segment<3>(3 * i), displacement);
    breaking_ += work.breaking;
    if (work.slip == 0.0) continue;
    const Contact& contact = contacts.points[i];
    displacement[0] = 0.0;
    const Vec3 way_A =
        start.poses[contact.block_a].q_WB.conjugate() * (contact_frame(contact.normal) * displacement);
    Slip& slip = slips_[contact.id];
    const bool back = slip.way_A.dot(way_A) < 0.0;
    slip.work = back ? std::abs(slip.work - work.slip) : slip.work + work.slip;
    slip.way_A += way_A;
  }
  yielding_ = 0.0;
  for (int tie = step.num_contacts; tie < step.problem.num_contacts(); ++tie)
    yielding_ += yield_work(step, tie, solution.step_solution);
}

double StepDissipation::total() const {
  double total = breaking_ + yielding_;
  for (const auto& [id, slip] : slips_) total += slip.work;
  return total;
}

}  // namespace cupola
