#include "solver/conic/embedding.hpp"

#include <algorithm>

namespace cupola {
Embedding::Embedding(const ScaledConicProblem& problem)
    : p_(problem.problem), white_(problem.white), equations_(problem), limits_(p_) {
  for (int i = 0; i < p_.contacts.num_contacts(); ++i)
    contacts_.emplace_back(p_.contacts.mu[i], Vec3::Zero());
  v_ = VecX::Zero(p_.load.size());
  q_ = VecX::Zero(p_.rows.cols());
  t_ = VecX::Zero(p_.load_columns.cols());
}

VecX Embedding::gamma() const {
  VecX gamma(p_.cost.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    gamma.segment<3>(3 * static_cast<Eigen::Index>(i)) = contacts_[i].force();
  return gamma;
}

Embedding::Point Embedding::point() const {
  Point point{{}, {}, limits_.slack, limits_.lambda, v_, q_, t_, tau_, kappa_};
  for (const ConicContact& contact : contacts_) {
    point.gamma.push_back(contact.gamma);
    point.z.push_back(contact.z);
  }
  return point;
}

void Embedding::move_to(const Point& point) {
  v_ = point.v;
  q_ = point.q;
  t_ = point.t;
  tau_ = point.tau;
  kappa_ = point.kappa;
  limits_.slack = point.slack;
  limits_.lambda = point.lambda;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    contacts_[i].gamma = point.gamma[i];
    contacts_[i].z = point.z[i];
  }
}

EmbeddingResiduals Embedding::residuals() const {
  const VecX gamma = this->gamma();
  EmbeddingResiduals r;
  const VecX forces = generalized_impulse(white_, gamma) + p_.load_columns * t_;
  const VecX conditions = p_.rows.transpose() * gamma + p_.row_multipliers.transpose() * t_;
  VecX dislocation = -(relative_velocity(white_, v_) - p_.rows * q_);  // s - D^T v + Q q
  dislocation -= limits_.on_contacts(limits_.lambda);
  const VecX power =
      p_.load_columns.transpose() * v_ - p_.row_multipliers * q_ - limits_.on_multipliers(limits_.lambda);
  VecX cost = p_.cost;
  for (int i = 0; i < p_.contacts.num_contacts(); ++i) {
    const ConicContact& contact = contacts_[i];
    dislocation.segment<3>(3 * i) += contact.to_cone.cwiseProduct(contact.z);
    if (!contact.frictionless) continue;
    dislocation.segment<2>(3 * i + 1).setZero();
    cost.segment<2>(3 * i + 1).setZero();
  }
  r.equilibrium = -(forces + tau_ * p_.load);
  r.rows = -(conditions - tau_ * p_.row_values);
  r.dual = -(dislocation - tau_ * cost);
  r.multipliers = -(tau_ * p_.multiplier_cost + power);
  r.limits = limits_.residual(gamma, t_, tau_);
  r.primal = p_.cost.dot(gamma) + p_.multiplier_cost.dot(t_);
  r.dual_value = p_.load.dot(v_) + p_.row_values.dot(q_) - limits_.on_tau(limits_.lambda);
  r.gap = -(kappa_ + r.primal - r.dual_value);
  r.primal_error =
      std::max({largest_entry(r.equilibrium), largest_entry(r.rows), largest_entry(r.limits)}) / tau_;
  r.dual_error = std::max(largest_entry(r.dual), largest_entry(r.multipliers)) / tau_;
  r.ray_error = std::max(
      {largest_entry(forces), largest_entry(conditions), largest_entry(limits_.residual(gamma, t_, 0.0))});
  r.mechanism_error = std::max(largest_entry(dislocation), largest_entry(power));
  return r;
}

void Embedding::balance_forces() {
  if (!factorize()) return;
  EmbeddingStep step{VecX::Zero(v_.size()),
                     VecX::Zero(q_.size()),
                     VecX::Zero(t_.size()),
                     VecX::Zero(p_.cost.size()),
                     0.0,
                     0.0,
                     {},
                     {},
                     {},
                     {},
                     0.0};
  EmbeddingResiduals r = residuals();
  r.multipliers.setZero();
  r.limits.setZero();
  const Targets targets{std::vector(contacts_.size(), Vec3(Vec3::Zero())), VecX::Zero(limits_.size()), 0.0};
  refine(r, 1.0, targets, &step);
  follow_limits(r, 1.0, targets, &step);
  const VecX slack = limits_.slack + step.slack;
  if ((slack.array() < 0.0).any()) return;
  std::vector<Vec3> balanced;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const ConicContact& contact = contacts_[i];
    const Vec3 gamma =
        contact.gamma + contact.to_cone.cwiseProduct(step.gamma.segment<3>(3 * static_cast<Eigen::Index>(i)));
    if (!(gamma[0] >= (contact.frictionless ? 0.0 : gamma.tail<2>().norm()))) return;
    balanced.push_back(gamma);
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) contacts_[i].gamma = balanced[i];
  t_ += step.t;
  limits_.slack = slack;
}

double Embedding::mean(double sum) const {
  return sum / static_cast<double>(contacts_.size() + static_cast<std::size_t>(limits_.size()) + 1);
}

double Embedding::complementarity() const {
  double sum = tau_ * kappa_;
  for (const ConicContact& contact : contacts_) sum += contact.nt.lambda.squaredNorm();
  return mean(sum + limits_.slack.dot(limits_.lambda));
}

double Embedding::complementarity_after(const EmbeddingStep& step, double length) const {
  double sum = (tau_ + length * step.tau) * (kappa_ + length * step.kappa);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Vec3 gamma = contacts_[i].gamma + length * step.cone_gamma[i],
               z = contacts_[i].z + length * step.cone_z[i];
    sum += contacts_[i].frictionless ? gamma[0] * z[0] : gamma.dot(z);
  }
  sum += (limits_.slack + length * step.slack).dot(limits_.lambda + length * step.lambda);
  return mean(sum);
}

void Embedding::take(const EmbeddingStep& step, double length) {
  v_ += length * step.v;
  q_ += length * step.q;
  t_ += length * step.t;
  tau_ += length * step.tau;
  kappa_ += length * step.kappa;
  limits_.slack += length * step.slack;
  limits_.lambda += length * step.lambda;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    contacts_[i].gamma += length * step.cone_gamma[i];
    contacts_[i].z += length * step.cone_z[i];
  }
}

}  // namespace cupola
