#include "solver/dynamics/islands.hpp"

#include <algorithm>

#include "assembly/base/disjoint_sets.hpp"
#include "assembly/base/error.hpp"
#include "assembly/case/case_times.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

ScenePart part_of(const Model& model, const State& state, const ContactSet& contacts,
                  const ContactMemories& memories, const std::vector<char>& chosen, char which) {
  ScenePart part{model, state, {}, {}, {}};
  part.model.free_blocks.clear();
  for (int i = 0; i < model.num_free(); ++i) {
    int& index = part.model.free_index[model.free_blocks[i]];
    index = chosen[i] == which ? part.model.num_free() : ContactProblem::kFixed;
    if (chosen[i] == which) part.model.free_blocks.push_back(model.free_blocks[i]);
  }
  const auto in_part = [&part](int block) { return part.model.free_index[block] != ContactProblem::kFixed; };
  std::erase_if(part.model.loads.points, [&](const PointLoad& load) { return !in_part(load.block); });
  part.state.v.resize(6 * part.model.num_free());
  for (int k = 0; k < part.model.num_free(); ++k)
    part.state.v.segment<6>(6 * k) = state.v.segment<6>(6 * model.free_index[part.model.free_blocks[k]]);
  part.contacts.patches = contacts.patches;
  for (int i = 0; i < static_cast<int>(contacts.points.size()); ++i) {
    if (!in_part(contacts.points[i].block_a) && !in_part(contacts.points[i].block_b)) continue;
    part.contact_rows.push_back(i);
    part.contacts.points.push_back(contacts.points[i]);
    part.memories.ids.push_back(memories.ids[i]);
    part.memories.values.push_back(memories.of(i));
  }
  part.model.ties.clear();
  for (size_t k = 0; k < model.ties.size(); ++k) {
    if (!in_part(model.ties[k].block_a) && !in_part(model.ties[k].block_b)) continue;
    part.model.ties.push_back(model.ties[k]);
    if (!memories.ties.empty()) part.memories.ties.push_back(memories.ties[k]);
  }
  return part;
}

std::vector<int> islands_of(const Model& model, const ContactSet& contacts) {
  DisjointSets islands(model.num_free());
  const auto join = [&](int block_a, int block_b) {
    const int a = model.free_index[block_a], b = model.free_index[block_b];
    if (a != ContactProblem::kFixed && b != ContactProblem::kFixed) islands.join(a, b);
  };
  for (const Contact& contact : contacts.points) join(contact.block_a, contact.block_b);
  for (const Tie& tie : model.ties) join(tie.block_a, tie.block_b);
  std::vector<int> island_of(model.num_free());
  for (int i = 0; i < model.num_free(); ++i) island_of[i] = islands.root(i);
  return island_of;
}

int SleepState::num_asleep() const {
  return static_cast<int>(std::count(asleep.begin(), asleep.end(), 1));
}

bool update_sleep(const Sleep& sleep, const std::vector<int>& islands, const std::vector<double>& radius,
                  State* state, SleepState* sleep_state) {
  const int nb = static_cast<int>(islands.size());
  CUPOLA_ASSERT(radius.size() == islands.size() && state->v.size() == 6 * nb);
  sleep_state->calm_since.resize(nb, state->time);
  sleep_state->asleep.resize(nb, 0);
  std::vector<double> last_fast = sleep_state->calm_since;  // by island: last time any block was fast
  for (int i = 0; i < nb; ++i) {
    const auto v = state->v.segment<6>(6 * i);
    if (v.head<3>().norm() + radius[i] * v.tail<3>().norm() > sleep.speed)
      sleep_state->calm_since[i] = state->time;
    last_fast[islands[i]] = std::max(last_fast[islands[i]], sleep_state->calm_since[i]);
  }
  bool changed = false;
  for (int i = 0; i < nb; ++i) {
    const char asleep = state->time - last_fast[islands[i]] >= sleep.time ? 1 : 0;
    if (asleep == sleep_state->asleep[i]) continue;
    changed = true;
    sleep_state->asleep[i] = asleep;
    if (asleep) state->v.segment<6>(6 * i).setZero();
  }
  return changed;
}

ReducedScene reduce_to_awake(const Model& model, const State& state, const ContactSet& contacts,
                             const ContactMemories& memories, const SleepState& sleep_state, double h) {
  CUPOLA_ASSERT(static_cast<int>(sleep_state.asleep.size()) == model.num_free());
  CUPOLA_ASSERT(memories.ids.size() == contacts.points.size() && h > 0.0);
  ReducedScene scene{part_of(model, state, contacts, memories, sleep_state.asleep, 0), {}, {}};
  for (size_t i = 0; i < contacts.points.size(); ++i)
    scene.forces.contacts.push_back(contact_frame(contacts.points[i].normal) * memories.of(i).impulse / h);
  const ScenePart asleep = part_of(model, state, contacts, memories, sleep_state.asleep, 1);
  JointForces carried;
  for (const int row : asleep.contact_rows) carried.contacts.push_back(scene.forces.contacts[row]);
  scene.balance = compute_equilibrium(asleep.model, asleep.state, asleep.contacts, carried, state.time);
  return scene;
}

void require_sleepable(const Case& scene, const Model& model) {
  const bool varying =
      std::ranges::any_of(times_of(scene), [](const KeyedTime& time) { return varies(time.function); });
  if (varying || scene.supports.moving() || !model.ties.empty())
    throw InputError(
        "analysis.sleep: requires loads, friction and supports that are constant in time, and no ties; "
        "remove analysis.sleep or what varies in time");
}

}  // namespace cupola
