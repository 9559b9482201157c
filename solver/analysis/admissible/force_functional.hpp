#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/analysis/admissible/joint_geometry.hpp"
#include "solver/dynamics/equilibrium.hpp"

namespace cupola {

/// A linear function of the forces between blocks.
struct ForceFunctional {
  std::map<int, Vec3> contacts;  ///< coefficient of the force of a contact on block b, world axes
  std::vector<double> ties;      ///< coefficient of the force of each tie
  double constant = 0.0;

  double operator()(const JointForces& forces) const;
  double size(const JointForces& forces) const;  ///< the sum of the sizes of its terms
  void add(int contact, const Vec3& coefficient) {
    contacts.try_emplace(contact, Vec3::Zero()).first->second += coefficient;
  }
  /// Its coefficients in the unknowns of a contact problem: three rows per contact, then three per tie.
  VecX coefficients(const ContactSet& contacts) const;
};

/// A quantity as a linear function of the forces, or as the ratio of two.
struct RangeObjective {
  std::string quantity, unit;  ///< as in ForceRange
  ForceFunctional value;
  std::optional<ForceFunctional> over = std::nullopt;
  std::optional<std::pair<int, int>> joint = std::nullopt;  ///< as in ForceRange
  /// The mean over the images of the joint about the axis, in an analysis of one sector: the value of all
  /// states that repeat.
  bool mean_of_images = false;

  double operator()(const JointForces& forces) const;  ///< NaN for a ratio to nothing
};

/// The forces of a model from which quantities are made, as built.
class ForceScene {
 public:
  ForceScene(const Case& of_case, const Model& of_model, const ContactSet& detected)
      : scene(of_case),
        model(of_model),
        assembly(*of_model.assembly),
        contacts(detected),
        joints(*of_model.assembly, detected) {}

  bool fixed(int block) const { return assembly.blocks[block].fixed; }
  std::string label(int block) const;
  ForceFunctional zero() const;
  /// Adds direction . (force of the pair on `block`).
  void add(const BlockPair& pair, int block, const Vec3& direction, ForceFunctional* f) const;

  const Case& scene;
  const Model& model;
  const Assembly& assembly;
  const ContactSet& contacts;
  const JointGeometry joints;
};

}  // namespace cupola
