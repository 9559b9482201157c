#include "solver/analysis/construction/stage_problem.hpp"

#include <algorithm>

#include "assembly/model/laying_course.hpp"
#include "solver/analysis/construction/mortar_age.hpp"
#include "solver/dynamics/laying_order.hpp"
#include "solver/dynamics/scene_options.hpp"

namespace cupola {
namespace {

/// Leaves the ties that act on free blocks and whose ends are laid, with the gaps that they have now.
void add_ties(const BuiltState& state, StageProblem* problem) {
  Model& model = problem->model;
  const std::vector<Tie> all = std::move(model.ties);
  model.ties.clear();
  const auto is_free = [&](int block) { return model.free_index[block] != ContactProblem::kFixed; };
  for (size_t k = 0; k < all.size(); ++k) {
    Tie tie = all[k];
    if (!state.laid[tie.block_a] || !state.laid[tie.block_b]) continue;
    if (!is_free(tie.block_a) && !is_free(tie.block_b)) continue;
    tie.natural_length += (tie.strut ? -1.0 : 1.0) * state.ties[k].loosening;
    model.ties.push_back(tie);
    problem->ties.push_back(static_cast<int>(k));
    problem->memories.ties.push_back(state.ties[k].memory);
  }
}

/// Leaves the given blocks free, and loads only on them.
void set_free(std::vector<int> blocks, Model* model) {
  const Assembly& assembly = *model->assembly;
  model->free_blocks = std::move(blocks);
  model->free_index.assign(assembly.blocks.size(), ContactProblem::kFixed);
  model->free_weight = 0.0;
  for (int i = 0; i < model->num_free(); ++i) {
    model->free_index[model->free_blocks[i]] = i;
    model->free_weight += assembly.blocks[model->free_blocks[i]].mass * model->loads.gravity.norm();
  }
  model->block_weight = model->num_free() > 0 ? model->free_weight / model->num_free() : 0.0;
  std::erase_if(model->loads.points, [&](const PointLoad& load) {
    return model->free_index[load.block] == ContactProblem::kFixed;
  });
}

}  // namespace

bool BuiltState::complete() const {
  return std::ranges::all_of(laid, [](char is_laid) { return is_laid == 1; });
}

BuildingSite::BuildingSite(const Case& the_case, const Assembly& of_it)
    : scene(the_case),
      assembly(of_it),
      course(laying_courses(of_it)),
      contacts(ContactDetector(of_it, detection_options(the_case)).update(initial_poses(of_it))) {
  // A joint is as old as the younger of its blocks, though two uprights may touch only in courses above.
  for (Patch& patch : contacts.patches) patch.course = std::max(course[patch.block_a], course[patch.block_b]);
}

bool BuildingSite::is_held(int block, int ring) const {
  const Block& at = assembly.blocks[block];
  return at.fixed || cupola::is_held(assembly, at, ring, scene.analysis.staged.hold_below);
}

Model stage_model(const BuildingSite& site, const BuiltState& state, const std::optional<double>& trial) {
  Case at = site.scene;
  StagedConstruction staged = at.analysis.staged;
  if (trial) set_fresh(*trial, &staged);
  at.supports = {};  // their motion is part of the state
  if (!state.complete()) {
    at.loads = Loads{};
    at.loads.gravity = site.scene.loads.gravity;
    at.loads.dead_load_time = site.scene.loads.dead_load_time;
  }
  Model model = make_model(at, site.assembly);
  model.joints.set_mortar(mortar_by_course(staged, state.ring));
  std::vector<int> blocks = model.free_blocks;
  std::erase_if(blocks, [&](int block) { return !state.laid[block] || site.is_held(block, state.ring); });
  set_free(std::move(blocks), &model);
  return model;
}

StageProblem stage_problem(const BuildingSite& site, const BuiltState& state,
                           const std::optional<double>& trial, FreeBlocks which) {
  StageProblem problem;
  problem.model = stage_model(site, state, trial);
  problem.num_blocks = problem.model.num_free();
  problem.weight = problem.model.free_weight;
  if (which == FreeBlocks::fresh) {
    std::vector<int> fresh = state.fresh;
    std::erase_if(fresh,
                  [&](int block) { return problem.model.free_index[block] == ContactProblem::kFixed; });
    set_free(std::move(fresh), &problem.model);
  }
  problem.rest = state_at_rest(problem.model);
  problem.contacts.patches = site.contacts.patches;
  problem.memories.as_built = false;
  const auto is_free = [&](int block) { return problem.model.free_index[block] != ContactProblem::kFixed; };
  const size_t most = site.contacts.points.size();
  problem.rows.reserve(most);
  problem.contacts.points.reserve(most);
  problem.memories.ids.reserve(most);
  problem.memories.values.reserve(most);
  for (size_t i = 0; i < most; ++i) {
    Contact contact = site.contacts.points[i];
    if (!state.laid[contact.block_a] || !state.laid[contact.block_b]) continue;
    if (!is_free(contact.block_a) && !is_free(contact.block_b)) continue;
    const BuiltContact& joint = state.joints[i];
    contact.gap = joint.gap;
    problem.rows.push_back(static_cast<int>(i));
    problem.contacts.points.push_back(contact);
    problem.memories.ids.push_back(contact.id);
    problem.memories.values.push_back(joint.memory);
  }
  add_ties(state, &problem);
  return problem;
}

}  // namespace cupola
