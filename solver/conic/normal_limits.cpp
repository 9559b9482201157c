#include "solver/conic/normal_limits.hpp"

#include <cmath>
#include <limits>

namespace cupola {

NormalLimits::NormalLimits(const ConicProblem& problem) : num_rows_(problem.cost.size()) {
  const auto size = std::ssize(problem.limits);
  const Eigen::Index nt = problem.load_columns.cols();
  slack = lambda = VecX::Ones(size);
  sign_.resize(size);
  bound_.resize(size);
  columns_ = MatX::Zero(size, nt);
  for (Eigen::Index k = 0; k < size; ++k) {
    const NormalLimit& limit = problem.limits[static_cast<size_t>(k)];
    contact_.push_back(limit.contact);
    sign_[k] = limit.sign;
    bound_[k] = limit.bound.constant;
    if (nt > 0) columns_.row(k) = limit.bound.slope.transpose();
  }
}

VecX NormalLimits::slack_change(const VecX& removed, const VecX& gamma, const VecX& t, double tau) const {
  VecX change = removed + tau * bound_ + columns_ * t;
  for (Eigen::Index k = 0; k < change.size(); ++k) change[k] -= sign_[k] * gamma[3 * contact_[k]];
  return change;
}

VecX NormalLimits::residual(const VecX& gamma, const VecX& t, double tau) const {
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  VecX missing = slack_change(-slack, gamma, t, tau);
  // Rounding is no residual: at an active limit the step would magnify it by lambda / slack.
  const VecX terms = tau * bound_.cwiseAbs() + columns_.cwiseAbs() * t.cwiseAbs();
  for (Eigen::Index k = 0; k < missing.size(); ++k)
    if (std::abs(missing[k]) <= kRounding * (terms[k] + std::abs(gamma[3 * contact_[k]]))) missing[k] = 0.0;
  return missing;
}

VecX NormalLimits::on_contacts(const VecX& x) const {
  VecX sum = VecX::Zero(num_rows_);
  for (Eigen::Index k = 0; k < x.size(); ++k) sum[3 * contact_[k]] += sign_[k] * x[k];
  return sum;
}

void NormalLimits::scale() {
  const VecX weight = lambda.cwiseQuotient(slack);
  stiffness_ = VecX::Zero(num_rows_ / 3);
  for (Eigen::Index k = 0; k < weight.size(); ++k) stiffness_[contact_[k]] += weight[k];
  const VecX weighted_bound = weight.cwiseProduct(bound_);
  tau_coupling_ = on_contacts(weighted_bound);
  tau_column_ = on_multipliers(weighted_bound);
  tau_shift_ = VecX::Zero(num_rows_);
  for (Eigen::Index i = 0; i < stiffness_.size(); ++i)
    if (stiffness_[i] > 0.0) tau_shift_[3 * i] = tau_coupling_[3 * i] / stiffness_[i];
  VecX rest = weighted_bound;
  for (Eigen::Index k = 0; k < rest.size(); ++k)
    rest[k] = weight[k] * (bound_[k] - sign_[k] * tau_shift_[3 * contact_[k]]);
  shifted_tau_column_ = on_multipliers(rest);
  shifted_tau_corner_ = on_tau(rest);
  coupling_.resize(num_rows_, columns_.cols());
  corner_.resize(columns_.cols(), columns_.cols());
  for (Eigen::Index j = 0; j < columns_.cols(); ++j) {
    const VecX weighted = weight.cwiseProduct(columns_.col(j));
    coupling_.col(j) = on_contacts(weighted);
    corner_.col(j) = on_multipliers(weighted);
  }
}

}  // namespace cupola
