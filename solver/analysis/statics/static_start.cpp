#include "solver/analysis/statics/static_start.hpp"

#include "solver/analysis/statics/analysis_options.hpp"

namespace cupola {

StaticStart start_from_equilibrium(const Case& scene, const std::function<void(const std::string&)>& log,
                                   Simulation* simulation) {
  const Model& model = simulation->model();
  StaticStart start;
  start.rest = state_at_rest(model);
  ContactDetector detector(*model.assembly, simulation->options().detection);
  start.contacts = contacts_at_rest(model, &detector);
  start.memories = match_memories({}, start.contacts.points);
  start.options = start_options(scene.analysis);
  start.options.log = log;
  start.solution = solve_static(model, start.rest, start.contacts, start.memories, start.options);
  if (start.solution.outcome == StaticOutcome::equilibrium)
    simulation->start_from(
        loaded_state(model, start.rest, start.contacts, start.memories, start.solution, start.options));
  return start;
}

}  // namespace cupola
