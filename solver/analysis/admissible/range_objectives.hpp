#pragma once

#include "assembly/model/force_quantity.hpp"
#include "solver/analysis/admissible/force_functional.hpp"

namespace cupola {

/// The objectives that a quantity stands for: one, or one per joint. Axes, centroids and areas are those of
/// the assembly as built. Throws InputError for a quantity that the model does not have: the thrust of a
/// wall, the joint of blocks that do not touch, the reaction of a block that rests on no support.
std::vector<RangeObjective> range_objectives(const ForceQuantity& quantity, const Case& scene,
                                             const Model& model, const ContactSet& contacts);

/// " along (x, y, z)" where a direction is given: quantities of one joint or block differ by it alone.
std::string along_text(const std::optional<Vec3>& direction);

// Those of single joints and courses, for range_objectives().
RangeObjective objective_of(const JointForce& joint, const ForceScene& scene);
RangeObjective objective_of(const HoopForce& hoop, const ForceScene& scene);
std::vector<RangeObjective> objectives_of(const AllJoints& all, const ForceScene& scene);

}  // namespace cupola
