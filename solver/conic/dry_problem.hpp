#pragma once

#include "solver/conic/conic_problem.hpp"

namespace cupola {

/// A conic problem whose joints have strength, as one of dry joints:
///
///  1. y = gamma + (sigma, 0, 0), with the largest pull that friction leaves, sigma = c / mu, lies in the friction cone.
///     sigma becomes a load. (mu = 0: sigma = T.)
///  2. A block without weight between the two sides of the joint has, besides the balance of its forces, a row for
///     y_n + slack = F + sigma or y_n - slack = sigma - T. Where both are needed, the second is
///     slack_1 + slack_2 = F + T in a row of one more block. The slacks are forces of contacts without friction.
///
/// These blocks have few neighbours, so that they cost little in the factor. Slacks of another size than the forces cost
/// digits, so that compressive strengths far beyond the loads can be left out at first.
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
  /// A linear function of the multipliers, t -> constant + slope . t.
  struct Linear {
    double constant = 0.0;
    VecX slope;
  };
  void add_limits(int contact);
  int add_block(const Linear& right_side);
  void split(int contact, int block, const Mat63& row);
  void add_contact(int a, int b, const Mat63& D_a, const Mat63& D_b, double mu);
  void shift_forces();
  void fill_vectors();
  Linear linear(int contact, double ContactStrength::*part) const;
  Linear apex(int contact) const;

  const ConicProblem& strong_;
  const Limits limits_;
  ConicProblem dry_;
  std::vector<Linear> right_sides_;  ///< of the rows of added blocks
  std::vector<double> added_mu_;
  std::vector<int> left_out_;  ///< contacts whose compressive strength is
  double scale_ = 1.0;         ///< N: rows of larger limits are divided, so that all have entries of one size
};

}  // namespace cupola
