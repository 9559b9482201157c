#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/model/force_quantity.hpp"
#include "solver/dynamics/equilibrium.hpp"

namespace cupola {

/// A linear function of the forces between blocks.
struct ForceFunctional {
  std::vector<Vec3> contacts;  ///< coefficient of the force on block b, world axes (nc)
  std::vector<double> ties;    ///< coefficient of the force of each tie
  double constant = 0.0;

  double operator()(const JointForces& forces) const;
  /// Its coefficients in the unknowns of a contact problem: three rows per contact, then three per tie.
  VecX coefficients(const ContactSet& contacts) const;
};

/// A quantity as a linear function of the forces, or as the ratio of two.
struct RangeObjective {
  std::string quantity, unit;  ///< as in ForceRange
  ForceFunctional value;
  std::optional<ForceFunctional> over;

  double operator()(const JointForces& forces) const;
};

/// The objectives that a quantity stands for: one, or one per joint. Axes, centroids and areas are those of the
/// assembly as built. Throws InputError for a quantity that the model does not have: the thrust of a wall, the joint of
/// blocks that do not touch, the reaction of a block that rests on no support.
std::vector<RangeObjective> range_objectives(const ForceQuantity& quantity, const Case& scene,
                                             const Model& model, const ContactSet& contacts);

}  // namespace cupola
