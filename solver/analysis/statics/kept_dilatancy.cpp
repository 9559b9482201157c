#include "solver/analysis/statics/kept_dilatancy.hpp"

#include <algorithm>

#include "solver/dynamics/joint_damage.hpp"

namespace cupola {

void keep_dilatancy(const StaticSolution& solution, const FlowRule& law, ContactMemories* memories) {
  if (law.dilatancy == 0.0) return;
  const StepProblem& step = solution.step;
  for (int i = 0; i < step.num_contacts; ++i) {
    if (solution.step_solution.gamma[3 * i] <= 0.0) continue;
    const Vec3 slid = solution.h * inelastic_velocity(step.problem, i, solution.step_solution);
    memories->values[i].rest_gap += std::max(0.0, slid[0]);
  }
}

std::vector<double> opened_by_sliding(const ContactMemories& memories, size_t num_blocks) {
  double most = 0.0;
  for (const ContactMemory& memory : memories.values) most = std::max(most, memory.rest_gap);
  return most > 0.0 ? std::vector<double>(num_blocks, most) : std::vector<double>{};
}

}  // namespace cupola
