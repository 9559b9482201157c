#include "solver/conic/embedding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cupola {
namespace {

double greatest(const VecX& x) {
  return x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0;
}

}  // namespace

Embedding::Embedding(const ConicProblem& problem) : p_(problem), equations_(problem) {
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
  Point point{{}, {}, v_, q_, t_, tau_, kappa_};
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
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    contacts_[i].gamma = point.gamma[i];
    contacts_[i].z = point.z[i];
  }
}

EmbeddingResiduals Embedding::residuals() const {
  const VecX gamma = this->gamma();
  EmbeddingResiduals r;
  const VecX forces = generalized_impulse(p_.contacts, gamma) + p_.load_columns * t_;
  const VecX conditions = p_.rows.transpose() * gamma + p_.row_multipliers.transpose() * t_;
  VecX dislocation = -(relative_velocity(p_.contacts, v_) - p_.rows * q_);  // s - D^T v + Q q
  const VecX power = p_.load_columns.transpose() * v_ - p_.row_multipliers * q_;
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
  r.primal = p_.cost.dot(gamma) + p_.multiplier_cost.dot(t_);
  r.dual_value = p_.load.dot(v_) + p_.row_values.dot(q_);
  r.gap = -(kappa_ + r.primal - r.dual_value);
  r.primal_error = std::max(greatest(r.equilibrium), greatest(r.rows)) / tau_;
  r.dual_error = std::max(greatest(r.dual), greatest(r.multipliers)) / tau_;
  r.ray_error = std::max(greatest(forces), greatest(conditions));
  r.mechanism_error = std::max(greatest(dislocation), greatest(power));
  return r;
}

bool Embedding::factorize() {
  std::vector<Mat3> V;
  V.reserve(contacts_.size());
  for (ConicContact& contact : contacts_) {
    contact.scale();
    V.push_back(contact.nt.W_inverse);
    if (!contact.frictionless) V.back() *= contact.to_cone.cwiseInverse().asDiagonal();
  }
  if (!equations_.factorize(std::move(V))) return false;
  const VecX G_cost = equations_.times_G(p_.cost);
  VecX border(q_.size() + t_.size());
  border << p_.row_values + p_.rows.transpose() * G_cost, p_.multiplier_cost;
  unit_ = equations_.solve(p_.load - generalized_impulse(p_.contacts, G_cost), border);
  unit_gamma_ = equations_.times_G(p_.rows * unit_.border.head(q_.size()) - p_.cost -
                                   relative_velocity(p_.contacts, unit_.v));
  return unit_gamma_.allFinite();
}

/// Newton direction that leaves the share `keep` of the residuals, for the scaled right-hand sides d of the
/// contacts and d_kappa of tau kappa.
EmbeddingStep Embedding::direction(const EmbeddingResiduals& r, double keep, const std::vector<Vec3>& d,
                                   double d_kappa) const {
  const double remove = 1.0 - keep;
  VecX scaled_d(r.dual.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    scaled_d.segment<3>(3 * static_cast<Eigen::Index>(i)) = d[i];
  const VecX G_h = equations_.times_V_transposed(scaled_d - remove * equations_.times_V(r.dual));
  const Eigen::Index nq = q_.size(), nt = t_.size();
  VecX border(nq + nt);
  border << remove * r.rows - p_.rows.transpose() * G_h, -remove * r.multipliers;
  const NormalEquations::Unknowns own =
      equations_.solve(generalized_impulse(p_.contacts, G_h) - remove * r.equilibrium, border);
  const VecX own_gamma = equations_.times_V_transposed(
      scaled_d + equations_.times_V(p_.rows * own.border.head(nq) - remove * r.dual -
                                    relative_velocity(p_.contacts, own.v)));

  const auto objective = [&](const VecX& gamma, const NormalEquations::Unknowns& u) {
    return p_.cost.dot(gamma) + p_.multiplier_cost.dot(u.border.tail(nt)) - p_.load.dot(u.v) -
           p_.row_values.dot(u.border.head(nq));
  };
  EmbeddingStep step;
  step.tau = (remove * r.gap - d_kappa / tau_ - objective(own_gamma, own)) /
             (objective(unit_gamma_, unit_) - kappa_ / tau_);
  step.kappa = (d_kappa - kappa_ * step.tau) / tau_;
  step.v = own.v + step.tau * unit_.v;
  step.q = own.border.head(nq) + step.tau * unit_.border.head(nq);
  step.t = own.border.tail(nt) + step.tau * unit_.border.tail(nt);
  step.gamma = own_gamma + step.tau * unit_gamma_;
  refine(r, remove, &step);
  // From the dual row: the scaling would lose the digits of s at contacts on the boundary of their cones.
  const VecX d_s =
      remove * r.dual + step.tau * p_.cost + relative_velocity(p_.contacts, step.v) - p_.rows * step.q;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const ConicContact& contact = contacts_[i];
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(i);
    const Vec3 d_gamma = contact.to_cone.cwiseProduct(step.gamma.segment<3>(row));
    Vec3 d_z = d_s.segment<3>(row);
    if (contact.frictionless)
      d_z.tail<2>().setZero();
    else
      d_z = d_z.cwiseQuotient(contact.to_cone);
    step.cone_gamma.push_back(d_gamma);
    step.cone_z.push_back(d_z);
    step.length = std::min(step.length, contact.largest_step(d_gamma, d_z));
  }
  if (step.tau < 0.0) step.length = std::min(step.length, -tau_ / step.tau);
  if (step.kappa < 0.0) step.length = std::min(step.length, -kappa_ / step.kappa);
  return step;
}

EmbeddingStep Embedding::predictor(const EmbeddingResiduals& r) const {
  std::vector<Vec3> d;
  d.reserve(contacts_.size());
  for (const ConicContact& contact : contacts_) d.push_back(-contact.nt.lambda);
  return direction(r, 0.0, d, -tau_ * kappa_);
}

EmbeddingStep Embedding::corrector(const EmbeddingResiduals& r, double sigma,
                                   const EmbeddingStep& predicted) const {
  const double target = sigma * complementarity();
  std::vector<Vec3> d;
  d.reserve(contacts_.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    d.push_back(contacts_[i].d(target, predicted.cone_gamma[i], predicted.cone_z[i]));
  return direction(r, sigma, d, target - tau_ * kappa_ - predicted.tau * predicted.kappa);
}

/// Removes what rounding left of the rows that `step` should satisfy. The normal equations subtract large
/// terms there; the rows themselves do not.
void Embedding::refine(const EmbeddingResiduals& r, double remove, EmbeddingStep* step) const {
  constexpr int kPasses = 3;
  const Eigen::Index nq = q_.size(), nt = t_.size();
  double last = std::numeric_limits<double>::infinity();
  EmbeddingStep best = *step;
  for (int pass = 0; pass <= kPasses; ++pass) {
    const VecX equilibrium = remove * r.equilibrium - generalized_impulse(p_.contacts, step->gamma) -
                             p_.load_columns * step->t - step->tau * p_.load;
    VecX border(nq + nt);
    border << remove * r.rows - p_.rows.transpose() * step->gamma - p_.row_multipliers.transpose() * step->t +
                  step->tau * p_.row_values,
        -(remove * r.multipliers - step->tau * p_.multiplier_cost - p_.load_columns.transpose() * step->v +
          p_.row_multipliers * step->q);
    const double error = std::max(greatest(equilibrium), greatest(border));
    if (!(error < last)) break;
    last = error;
    best = *step;
    if (pass == kPasses) break;
    const NormalEquations::Unknowns change = equations_.solve(-equilibrium, border);
    step->v += change.v;
    step->q += change.border.head(nq);
    step->t += change.border.tail(nt);
    step->gamma +=
        equations_.times_G(p_.rows * change.border.head(nq) - relative_velocity(p_.contacts, change.v));
  }
  *step = best;
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
                     0.0};
  refine(residuals(), 1.0, &step);
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
}

double Embedding::complementarity() const {
  double sum = tau_ * kappa_;
  for (const ConicContact& contact : contacts_) sum += contact.nt.lambda.squaredNorm();
  return sum / static_cast<double>(contacts_.size() + 1);
}

double Embedding::complementarity_after(const EmbeddingStep& step, double length) const {
  double sum = (tau_ + length * step.tau) * (kappa_ + length * step.kappa);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Vec3 gamma = contacts_[i].gamma + length * step.cone_gamma[i],
               z = contacts_[i].z + length * step.cone_z[i];
    sum += contacts_[i].frictionless ? gamma[0] * z[0] : gamma.dot(z);
  }
  return sum / static_cast<double>(contacts_.size() + 1);
}

void Embedding::take(const EmbeddingStep& step, double length) {
  v_ += length * step.v;
  q_ += length * step.q;
  t_ += length * step.t;
  tau_ += length * step.tau;
  kappa_ += length * step.kappa;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    contacts_[i].gamma += length * step.cone_gamma[i];
    contacts_[i].z += length * step.cone_z[i];
  }
}

}  // namespace cupola
