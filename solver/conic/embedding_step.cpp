// Newton steps of the embedding.

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/conic/embedding.hpp"

namespace cupola {
namespace {

/// Adds the stiffness k of limits to that of a contact, G^-1 = (V^T V)^-1: with the reflection R that maps x
/// = V e, e = (1, 0, 0), on its length times e,
///
///     (G^-1 + k e e^T)^-1 = V^T (I + k x x^T)^-1 V = (A V)^T (A V),
///     A = diag(1 / sqrt(1 + k x . x), 1, 1) R
///
/// Returns A. The entries of V that are then zero are set to zero: near an active limit k has many digits
/// more than x.
Mat3 stiffen(double k, Mat3* V) {
  const Vec3 x = V->col(0);
  const double length = x.norm();
  Vec3 mirror = x;
  mirror[0] += x[0] < 0.0 ? -length : length;  // maps x on -length e or length e; the sign does not matter
  Mat3 A = Mat3::Identity() - 2.0 / mirror.squaredNorm() * mirror * mirror.transpose();
  A.row(0) /= std::sqrt(1.0 + k * length * length);
  *V = A * *V;
  V->col(0).tail<2>().setZero();
  return A;
}

}  // namespace

bool Embedding::factorize() {
  limits_.scale();
  stiffened_.assign(contacts_.size(), Mat3::Identity());
  std::vector<Mat3> V;
  V.reserve(contacts_.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    ConicContact& contact = contacts_[i];
    contact.scale();
    V.push_back(contact.nt.W_inverse);
    if (!contact.frictionless) V.back() *= contact.to_cone.cwiseInverse().asDiagonal();
    const double k = limits_.stiffness()[static_cast<Eigen::Index>(i)];
    if (k > 0.0) stiffened_[i] = stiffen(k, &V.back());
  }
  if (!equations_.factorize(std::move(V), limits_.coupling(), limits_.corner())) return false;
  const Eigen::Index nt = t_.size();
  // d_tau = 1 moves gamma by the shift of the limits and by unit_gamma_, which the solve finds to its own
  // digits.
  const VecX& shift = limits_.tau_shift();
  VecX cost = p_.cost;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (const Eigen::Index row = 3 * static_cast<Eigen::Index>(i); shift[row] != 0.0)
      cost.segment<3>(row) += shift[row] * contacts_[i].compliance().col(0);
  const VecX G_cost = equations_.times_G(cost);
  VecX border = equations_.on_border(G_cost);
  border.head(q_.size()) += p_.row_values - p_.rows.transpose() * shift;
  border.tail(nt) += p_.multiplier_cost + limits_.shifted_tau_column();
  unit_ = equations_.solve(p_.load + generalized_impulse(white_, VecX(shift - G_cost)), border);
  unit_gamma_ =
      equations_.times_G(equations_.times_border(unit_.border) - cost - relative_velocity(white_, unit_.v));
  return unit_gamma_.allFinite();
}

/// Newton direction that leaves the share `keep` of the residuals.
EmbeddingStep Embedding::direction(const EmbeddingResiduals& r, double keep, const Targets& targets) const {
  const double remove = 1.0 - keep;
  VecX scaled_d(r.dual.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    scaled_d.segment<3>(3 * static_cast<Eigen::Index>(i)) = stiffened_[i] * targets.d[i];
  }
  // lambda as it would change if gamma, t and tau did not.
  const VecX own_lambda = limits_.lambda_change(targets.limits, remove * r.limits);
  const VecX dual = remove * r.dual + limits_.on_contacts(own_lambda);
  const VecX G_h = equations_.times_V_transposed(scaled_d - equations_.times_V(dual));
  const Eigen::Index nq = q_.size(), nt = t_.size();
  VecX border = -equations_.on_border(G_h);
  border.head(nq) += remove * r.rows;
  border.tail(nt) -= remove * r.multipliers + limits_.on_multipliers(own_lambda);
  const NormalEquations::Unknowns own =
      equations_.solve(generalized_impulse(white_, G_h) - remove * r.equilibrium, border);
  const VecX own_gamma =
      equations_.times_V_transposed(scaled_d + equations_.times_V(equations_.times_border(own.border) - dual -
                                                                  relative_velocity(white_, own.v)));

  const auto objective = [&](const VecX& gamma, const NormalEquations::Unknowns& u) {
    return (p_.cost + limits_.tau_coupling()).dot(gamma) +
           (p_.multiplier_cost - limits_.tau_column()).dot(u.border.tail(nt)) - p_.load.dot(u.v) -
           p_.row_values.dot(u.border.head(nq));
  };
  EmbeddingStep step;
  step.tau =
      (remove * r.gap - targets.kappa / tau_ - objective(own_gamma, own) - limits_.on_tau(own_lambda)) /
      (objective(unit_gamma_, unit_) + p_.cost.dot(limits_.tau_shift()) - limits_.shifted_tau_corner() -
       kappa_ / tau_);
  step.kappa = (targets.kappa - kappa_ * step.tau) / tau_;
  step.v = own.v + step.tau * unit_.v;
  step.q = own.border.head(nq) + step.tau * unit_.border.head(nq);
  step.t = own.border.tail(nt) + step.tau * unit_.border.tail(nt);
  step.gamma = own_gamma + step.tau * (limits_.tau_shift() + unit_gamma_);
  refine(r, remove, targets, &step);
  follow_limits(r, remove, targets, &step);
  complete(r, remove, &step);
  return step;
}

/// s and the length of a step from its other parts.
void Embedding::complete(const EmbeddingResiduals& r, double remove, EmbeddingStep* step) const {
  // From the dual row: the scaling would lose the digits of s at contacts on the boundary of their cones.
  const VecX d_s = remove * r.dual + step->tau * p_.cost + relative_velocity(white_, step->v) -
                   p_.rows * step->q + limits_.on_contacts(step->lambda);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const ConicContact& contact = contacts_[i];
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(i);
    const Vec3 d_gamma = contact.to_cone.cwiseProduct(step->gamma.segment<3>(row));
    Vec3 d_z = d_s.segment<3>(row);
    if (contact.frictionless)
      d_z.tail<2>().setZero();
    else
      d_z = d_z.cwiseQuotient(contact.to_cone);
    step->cone_gamma.push_back(d_gamma);
    step->cone_z.push_back(d_z);
    step->length = contact.largest_step(d_gamma, d_z, step->length);
  }
  const auto keep_positive = [step](double x, double change) {
    if (change < 0.0) step->length = std::min(step->length, -x / change);
  };
  keep_positive(tau_, step->tau);
  keep_positive(kappa_, step->kappa);
  for (int k = 0; k < limits_.size(); ++k) {
    keep_positive(limits_.slack[k], step->slack[k]);
    keep_positive(limits_.lambda[k], step->lambda[k]);
  }
}

/// Slack and lambda for the gamma, t and tau of a step.
void Embedding::follow_limits(const EmbeddingResiduals& r, double remove, const Targets& targets,
                              EmbeddingStep* step) const {
  step->slack = limits_.slack_change(remove * r.limits, step->gamma, step->t, step->tau);
  step->lambda = limits_.lambda_change(targets.limits, step->slack);
}

EmbeddingStep Embedding::predictor(const EmbeddingResiduals& r) const {
  Targets targets{{}, -limits_.lambda.cwiseProduct(limits_.slack), -tau_ * kappa_};
  targets.d.reserve(contacts_.size());
  for (const ConicContact& contact : contacts_) targets.d.push_back(-contact.nt.lambda);
  return direction(r, 0.0, targets);
}

EmbeddingStep Embedding::corrector(const EmbeddingResiduals& r, double sigma,
                                   const EmbeddingStep& predicted) const {
  const double target = sigma * complementarity();
  Targets targets{{}, {}, target - tau_ * kappa_ - predicted.tau * predicted.kappa};
  targets.d.reserve(contacts_.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    targets.d.push_back(contacts_[i].d(target, predicted.cone_gamma[i], predicted.cone_z[i]));
  targets.limits = (target - limits_.lambda.array() * limits_.slack.array() -
                    predicted.lambda.array() * predicted.slack.array())
                       .matrix();
  return direction(r, sigma, targets);
}

/// Removes what rounding left of the rows that `step` should satisfy, down to a small share of the residuals
/// or of the loads; with limits, whose slack magnifies it, as far as possible. The normal equations subtract
/// large terms there; the rows themselves do not.
void Embedding::refine(const EmbeddingResiduals& r, double remove, const Targets& targets,
                       EmbeddingStep* step) const {
  constexpr int kPasses = 3;
  constexpr double kShare = 1e-2, kSmallest = 1e-14;  // the latter 1e-2 of ConicOptions::target
  const double residual =
      std::max({largest_entry(r.equilibrium), largest_entry(r.rows), largest_entry(r.multipliers)});
  const double enough = limits_.size() > 0 ? 0.0 : std::max(kShare * residual, kSmallest * tau_);
  const Eigen::Index nq = q_.size(), nt = t_.size();
  double last = std::numeric_limits<double>::infinity();
  EmbeddingStep best = *step;
  for (int pass = 0; pass <= kPasses; ++pass) {
    const VecX equilibrium = remove * r.equilibrium - generalized_impulse(white_, step->gamma) -
                             p_.load_columns * step->t - step->tau * p_.load;
    follow_limits(r, remove, targets, step);
    VecX border(nq + nt);
    border << remove * r.rows - p_.rows.transpose() * step->gamma - p_.row_multipliers.transpose() * step->t +
                  step->tau * p_.row_values,
        -(remove * r.multipliers - step->tau * p_.multiplier_cost - p_.load_columns.transpose() * step->v +
          p_.row_multipliers * step->q + limits_.on_multipliers(step->lambda));
    const double error = std::max(largest_entry(equilibrium), largest_entry(border));
    if (!(error < last)) break;
    last = error;
    best = *step;
    if (error <= enough || pass == kPasses) break;
    const NormalEquations::Unknowns change = equations_.solve(-equilibrium, border);
    step->v += change.v;
    step->q += change.border.head(nq);
    step->t += change.border.tail(nt);
    step->gamma +=
        equations_.times_G(equations_.times_border(change.border) - relative_velocity(white_, change.v));
  }
  *step = best;
}

}  // namespace cupola
