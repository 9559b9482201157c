#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "assembly/model/block_names.hpp"
#include "assembly/model/joint_rule.hpp"
#include "solver/analysis/statics/equilibrium_path.hpp"
#include "solver/analysis/statics/static_step.hpp"
#include "solver/collision/fast_blocks.hpp"

// What follows a step of a path: whether its end is near enough, and equilibrium in the geometry there.

namespace cupola {

/// What a solve that balances the loads but for its residual leaves undetermined of the displacement, m. A
/// start nearby has longer steps, in which joints limit the displacement, not the inertia of a step.
double EquilibriumPath::displacement_by_imbalance(const StaticSolution& solution) const {
  constexpr double kMargin = 3.0;  // the residual is over the mean weight, in forces and in moments
  const double acceleration = reference_acceleration(model_, start_);
  const double h = std::min(solution.h, first_static_step(model_, start_, contacts_, acceleration, options_));
  return kMargin * solution.balance.residual * acceleration * h * h;
}

bool EquilibriumPath::is_settled(const StaticSolution& solution) const {
  constexpr double kSettled = 1e-8, kNegligible = 1e-5;  // of the smallest block
  const double moved = displacement_of(solution) / smallest_block_size(*model_.assembly);
  return moved <= kSettled ||
         (moved <= kNegligible && displacement_of(solution) <= displacement_by_imbalance(solution));
}

std::string EquilibriumPath::too_far(const LoadedState& last, const StaticSolution& solution) const {
  // Chosen: levers multiply what supports move.
  constexpr double kLever = 10.0;
  const Assembly& assembly = *model_.assembly;
  const double way = displacement_of(solution), size = smallest_block_size(assembly);
  if (!options_.control && way > size + kLever * imposed_displacement(model_, start_, options_))
    return fmt::format("blocks move by {:.2g} m in one step, where the smallest has {:.2g} m", way, size);
  if (const auto fast = fast_pair(detector_.model(), last.state.poses, loaded_.state.poses, 1.0, 1.0))
    return fmt::format("block {} moves by {:.2g} m in one step, and may pass block {}",
                       block_label(assembly, fast->block), fast->way, block_label(assembly, fast->other));
  return {};
}

StaticSolution EquilibriumPath::correct(const std::vector<TieMemory>& ties, StaticSolution solution) {
  constexpr int kMost = 200;  // of a slender tower that sways each takes away a tenth
  const double by_step = std::max(displacement_of(solution), imposed_displacement(model_, start_, options_));
  for (int pass = 0; !is_settled(solution); ++pass) {
    const double further = displacement_of(solution);
    if (pass == kMost || (pass > 0 && further > std::max(by_step, displacement_by_imbalance(solution)))) {
      solution.outcome = pass == kMost ? StaticOutcome::unconverged : StaticOutcome::moving;
      solution.proven = false;
      solution.message =
          fmt::format("in the geometry at the end of the step blocks move on by {:.2g} m", further);
      break;
    }
    const int iterations = solution.iterations;
    options_.nearby = NearbyStart{};
    if (options_.control) options_.control->displacement = 0.0;  // it stays where the step has led
    // The elongation of a tie follows from where its ends are: it yields by as much as at the end.
    LoadedState from = loaded_;
    for (size_t k = 0; k < from.memories.ties.size(); ++k)
      from.memories.ties[k].yielded = k < ties.size() ? ties[k].yielded : 0.0;
    solution = solve_from(from, 0.0);
    solution.iterations += iterations;
    if (solution.outcome == StaticOutcome::equilibrium) continue;
    solution.message = "in the geometry at the end of the step: " + solution.message;
    break;
  }
  return solution;
}

}  // namespace cupola
