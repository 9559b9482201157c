#pragma once

#include "solver/conic/conic_problem.hpp"

namespace cupola {

/// A conic problem whose joints have strength, as one of dry joints:
///
///  1. y = gamma + (sigma, 0, 0), with the largest pull that friction leaves, sigma = c / mu, lies in the
///     friction cone. sigma becomes a load. (mu = 0: sigma = T.)
///  2. y_n <= F + sigma, and -y_n <= T - sigma where T < sigma, become limits.
///
/// Slacks of another size than the forces cost digits, so that compressive strengths far beyond the loads can
/// be left out at first.
class DryProblem {
 public:
  enum class Limits { near_loads, all };
  /// Throws std::invalid_argument for a contact with cohesion but without friction, whose set is not a cone.
  DryProblem(const ConicProblem& strong, Limits limits);

  const ConicProblem& problem() const { return dry_; }
  /// False if the solution shows that the limits left out are needed.
  bool solves(const ConicSolution& original) const;
  /// A solution of problem() in the unknowns of the original; `primal` and `dual` are left to the caller.
  ConicSolution original(const ConicSolution& dry) const;

 private:
  void add_limits(int contact);
  void shift_forces();
  OfMultipliers linear(int contact, double ContactStrength::*part) const;
  OfMultipliers apex(int contact) const;

  const ConicProblem& strong_;
  const Limits limits_;
  ConicProblem dry_;
  std::vector<int> left_out_;  ///< contacts whose compressive strength is
  double largest_load_ = 0.0;  ///< N, of a block
};

}  // namespace cupola
