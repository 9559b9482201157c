#pragma once

#include <vector>

#include "solver/conic/conic_problem.hpp"

namespace cupola {

/// The limits of a conic problem at one iterate of the embedding (embedding.hpp), which adds to its rows
///
///     sign gamma_n + slack = bound tau + columns t,          slack, lambda >= 0
///     s = c tau + D^T v - Q q + sum sign lambda (1, 0, 0),    e tau + P^T v - R q = columns^T lambda
///     kappa = ... - bound . lambda
///
/// In a Newton step slack and lambda follow from gamma, t and tau by their own row and
/// lambda d_slack + slack d_lambda = d.
class NormalLimits {
 public:
  explicit NormalLimits(const ConicProblem& problem);
  int size() const { return static_cast<int>(slack.size()); }

  VecX slack, lambda;  ///< (nl), > 0

  /// bound tau + columns t - sign gamma_n - slack: what the rows lack.
  VecX residual(const VecX& gamma, const VecX& t, double tau) const;
  /// The sum of sign x over the limits of each contact, as normal components (3 nc).
  VecX on_contacts(const VecX& x) const;
  /// columns^T x (nt) and bound . x
  VecX on_multipliers(const VecX& x) const { return columns_.transpose() * x; }
  double on_tau(const VecX& x) const { return bound_.dot(x); }

  /// Updates the weights lambda / slack and what follows from them.
  void scale();
  /// Stiffness of the normal force: the sum of the weights of each contact (nc).
  const VecX& stiffness() const { return stiffness_; }
  /// sum sign weight columns and sum sign weight bound, as normal components (3 nc, nt; 3 nc)
  const MatX& coupling() const { return coupling_; }
  const VecX& tau_coupling() const { return tau_coupling_; }
  /// What gamma_n would change with tau if the limits of a contact were all that holds it: the mean of sign
  /// bound by weight, as normal components (3 nc). Near active limits gamma follows it up to small
  /// differences.
  const VecX& tau_shift() const { return tau_shift_; }
  /// columns^T weight columns, columns^T weight bound; and columns^T and bound . weight (bound - sign
  /// tau_shift).
  const MatX& corner() const { return corner_; }
  const VecX& tau_column() const { return tau_column_; }
  const VecX& shifted_tau_column() const { return shifted_tau_column_; }
  double shifted_tau_corner() const { return shifted_tau_corner_; }
  /// Changes of lambda for those of gamma, t and tau; d and the residual removed as above.
  VecX lambda_change(const VecX& d, const VecX& slack_change) const {
    return (d - lambda.cwiseProduct(slack_change)).cwiseQuotient(slack);
  }
  /// Changes of slack.
  VecX slack_change(const VecX& removed, const VecX& gamma, const VecX& t, double tau) const;

 private:
  std::vector<int> contact_;
  VecX sign_, bound_;
  MatX columns_;
  Eigen::Index num_rows_;  ///< 3 nc
  VecX stiffness_, tau_coupling_, tau_shift_, tau_column_, shifted_tau_column_;
  MatX coupling_, corner_;
  double shifted_tau_corner_ = 0.0;
};

}  // namespace cupola
