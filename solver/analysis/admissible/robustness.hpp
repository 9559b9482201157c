#pragma once

#include <memory>
#include <optional>

#include "assembly/case/case.hpp"
#include "assembly/model/results.hpp"

namespace cupola {

/// The least horizontal acceleration of all free blocks, over `scene.analysis.robustness` directions, for
/// which a mechanism proves that no admissible state exists: one conic programme each, which maximises the
/// multiplier of the loads that the acceleration adds. None if no direction has a limit or the structure has
/// no admissible state at rest.
std::optional<Robustness> find_robustness(const Case& scene, const Assembly& assembly);

/// One clause for the message of a run.
std::string describe(const Robustness& robustness);

}  // namespace cupola
