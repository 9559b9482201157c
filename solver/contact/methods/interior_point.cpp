#include "solver/contact/methods/interior_point.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/problem/conic_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/runtime/interruption.hpp"

namespace cupola {

namespace {

constexpr double kToBoundary = 0.99;  // share of the step to the boundary

struct Step {
  VecX w, gamma, z;  ///< gamma and z in cone coordinates
  double length = 0.0;
};

class InteriorPoint {
 public:
  InteriorPoint(const WhitenedProblem& problem, const SolveOptions& options, SolveSummary* summary)
      : white_(problem), options_(options), summary_(*summary), graph_(contact_graph(p_)) {}

  bool start();  ///< all-stick velocities, with impulses and slacks moved into their cones
  void run();
  const VecX& w() const { return w_; }
  VecX gamma() const;

 private:
  bool factorize();
  Step direction(const std::vector<Vec3>& d) const;
  void update_residuals();
  double mean_complementarity() const;
  double mean_elastic_work() const;
  bool should_stop();

  const WhitenedProblem& white_;
  const ContactProblem& p_ = white_.given;
  const SolveOptions& options_;
  SolveSummary& summary_;
  ContactGraph graph_;
  BlockCholesky factor_;
  std::vector<ConicContact> contacts_;
  VecX w_;
  VecX r_d_;  ///< w - w_star - J gamma (6 nb)
  VecX r_p_;  ///< J^T w + b + E gamma - z (3 nc)
};

VecX InteriorPoint::gamma() const {
  VecX gamma(p_.b.size());
  for (int i = 0; i < p_.num_contacts(); ++i) gamma.segment<3>(3 * i) = contacts_[i].force();
  return gamma;
}

/// x moved along the axis of the cone until x_0 - |x_t| >= `margin`.
Vec3 pushed_inside(Vec3 x, double margin) {
  x[0] = std::max(x[0], x.tail<2>().norm() + margin);
  return x;
}

bool InteriorPoint::start() {
  const int nc = p_.num_contacts();
  contacts_.reserve(nc);
  std::vector<Mat3> G(nc);
  VecX impulse(3 * nc);
  constexpr double kRigidStiffness = 1.0;  // whitened, unit mass: of the order of the blocks' own response
  for (int i = 0; i < nc; ++i) {
    const ConicContact& contact = contacts_.emplace_back(p_.mu[i], p_.E.segment<3>(3 * i));
    Vec3 stiffness = Vec3::Constant(kRigidStiffness);
    for (int k = 0; k < 3; ++k) {
      if (contact.E[k] > 0.0) stiffness[k] = 1.0 / contact.E[k];
    }
    if (contact.frictionless) stiffness.tail<2>().setZero();
    G[i] = stiffness.asDiagonal();
    impulse.segment<3>(3 * i) = -G[i] * p_.b.segment<3>(3 * i);
  }
  ++summary_.factorizations;
  if (!factor_.factorize(graph_.pattern, assemble_hessian(white_, graph_, G))) return false;
  w_ = factor_.solve(white_.w_star + generalized_impulse(white_, impulse));

  const VecX y = relative_velocity(white_, w_) + p_.b;
  double mean_gamma = 0.0, mean_y = 0.0;
  for (int i = 0; i < nc; ++i) {
    mean_gamma += (G[i] * y.segment<3>(3 * i)).norm() / nc;
    mean_y += y.segment<3>(3 * i).norm() / nc;
  }
  const double tiny = std::numeric_limits<double>::min();
  for (int i = 0; i < nc; ++i) {
    ConicContact& contact = contacts_[i];
    const Vec3 gamma = -G[i] * y.segment<3>(3 * i);
    contact.gamma = pushed_inside(contact.to_cone.cwiseProduct(gamma), mean_gamma + tiny);
    contact.z = Vec3(std::max(mean_y, std::abs(y[3 * i])) + tiny, 0.0, 0.0);
  }
  return w_.allFinite();
}

void InteriorPoint::update_residuals() {
  const VecX impulses = gamma();
  r_d_ = w_ - white_.w_star - generalized_impulse(white_, impulses);
  r_p_ = relative_velocity(white_, w_) + p_.b + p_.E.cwiseProduct(impulses);
  for (int i = 0; i < p_.num_contacts(); ++i) {
    const ConicContact& contact = contacts_[i];
    if (contact.frictionless) {
      r_p_.segment<2>(3 * i + 1).setZero();
      r_p_[3 * i] -= contact.z[0];
    } else {
      r_p_.segment<3>(3 * i) -= contact.to_cone.cwiseProduct(contact.z);
    }
  }
}

bool InteriorPoint::factorize() {
  std::vector<Mat3> G(contacts_.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    contacts_[i].scale();
    G[i] = contacts_[i].G;
  }
  ++summary_.factorizations;
  return factor_.factorize(graph_.pattern, assemble_hessian(white_, graph_, G));
}

/// Newton direction of the scaled system for the right-hand sides d, and the longest step that stays in the
/// cones.
Step InteriorPoint::direction(const std::vector<Vec3>& d) const {
  VecX rhs(p_.b.size());  // S W d - r_p
  for (int i = 0; i < p_.num_contacts(); ++i) {
    rhs.segment<3>(3 * i) =
        contacts_[i].to_cone.cwiseProduct(contacts_[i].nt.W * d[i]) - r_p_.segment<3>(3 * i);
  }
  VecX G_rhs(rhs.size());
  for (int i = 0; i < p_.num_contacts(); ++i)
    G_rhs.segment<3>(3 * i) = contacts_[i].G * rhs.segment<3>(3 * i);
  Step step{factor_.solve(generalized_impulse(white_, G_rhs) - r_d_), VecX(rhs.size()), VecX(rhs.size()),
            10.0};
  const VecX dy = relative_velocity(white_, step.w);
  for (int i = 0; i < p_.num_contacts(); ++i) {
    const ConicContact& contact = contacts_[i];
    const Vec3 d_gamma = contact.to_cone.cwiseProduct(contact.G * (rhs - dy).segment<3>(3 * i));
    const Vec3 d_z = contact.nt.W * (d[i] - contact.nt.W * d_gamma);
    step.gamma.segment<3>(3 * i) = d_gamma;
    step.z.segment<3>(3 * i) = d_z;
    step.length = contact.largest_step(d_gamma, d_z, step.length);
  }
  return step;
}

double InteriorPoint::mean_complementarity() const {
  double sum = 0.0;
  for (const ConicContact& contact : contacts_) sum += contact.nt.lambda.squaredNorm();
  return sum / static_cast<double>(contacts_.size());
}

double InteriorPoint::mean_elastic_work() const {
  const VecX impulses = gamma();
  const double work = impulses.dot(p_.E.cwiseProduct(impulses));
  const double floor = 1e-12 * impulses.norm() * std::sqrt(1.0 * impulses.size()) * options_.reference_speed;
  return std::max(work, floor) / static_cast<double>(contacts_.size());
}

bool InteriorPoint::should_stop() {
  constexpr int kDefaultIterations = 80;
  const int limit = options_.max_iterations.value_or(kDefaultIterations);
  const double relative = mean_complementarity() / mean_elastic_work();
  summary_.residual_history.push_back(relative);
  if (!std::isfinite(relative)) {
    summary_.ending = SolveEnding::failed;
    summary_.message =
        fmt::format("complementarity became {} in iteration {}", relative, summary_.iterations);
    return true;
  }
  if (relative <= options_.tolerance) {
    summary_.ending = SolveEnding::converged;
    summary_.message = fmt::format("complementarity {:.2e} <= tolerance {:.2e} of the elastic work after {}",
                                   relative, options_.tolerance, counted(summary_.iterations, "iteration"));
    return true;
  }
  if (summary_.iterations >= limit) {
    summary_.ending = SolveEnding::max_iterations;
    summary_.message = fmt::format("complementarity {:.2e} > tolerance {:.2e} of the elastic work after {}",
                                   relative, options_.tolerance, counted(summary_.iterations, "iteration"));
    return true;
  }
  return false;
}

void InteriorPoint::run() {
  constexpr double kSmallestStep = 1e-6;
  const int nc = p_.num_contacts();
  while (true) {
    throw_if_interrupted();
    update_residuals();
    if (!factorize()) {
      summary_.ending = SolveEnding::stalled;
      summary_.message =
          fmt::format("the scaled Hessian is no longer positive definite in double precision (iteration {})",
                      summary_.iterations);
      return;
    }
    if (should_stop()) return;
    ++summary_.iterations;

    // 1. Predictor: zero complementarity
    const double mu_c = mean_complementarity();
    std::vector<Vec3> d(nc);
    for (int i = 0; i < nc; ++i) d[i] = -contacts_[i].nt.lambda;
    const Step affine = direction(d);
    const double reach = std::min(1.0, affine.length);
    double predicted = 0.0;
    for (int i = 0; i < nc; ++i) {
      predicted += (contacts_[i].gamma + reach * affine.gamma.segment<3>(3 * i))
                       .dot(contacts_[i].z + reach * affine.z.segment<3>(3 * i)) /
                   nc;
    }
    const double sigma = std::pow(std::clamp(predicted / mu_c, 0.0, 1.0), 3);

    // 2. Corrector: towards the central path
    for (int i = 0; i < nc; ++i) {
      d[i] = contacts_[i].d(sigma * mu_c, affine.gamma.segment<3>(3 * i), affine.z.segment<3>(3 * i));
    }
    const Step step = direction(d);
    const double t = std::min(1.0, kToBoundary * step.length);
    if (!(t > kSmallestStep)) {
      summary_.ending = SolveEnding::stalled;
      summary_.message =
          fmt::format("step length {:.1e} in iteration {}: the scaling has lost its accuracy to rounding", t,
                      summary_.iterations);
      return;
    }
    w_ += t * step.w;
    for (int i = 0; i < nc; ++i) {
      contacts_[i].gamma += t * step.gamma.segment<3>(3 * i);
      contacts_[i].z += t * step.z.segment<3>(3 * i);
    }
  }
}

}  // namespace

SolveSummary solve_interior_point(const ContactProblem& problem, const SolveOptions& options,
                                  ContactSolution* solution) {
  options.validate();
  SolveSummary summary;
  if (summary.message = problem.defect(); !summary.message.empty()) return summary;
  const WhitenedProblem white = whiten(problem);
  InteriorPoint method(white, options, &summary);
  if (problem.num_contacts() == 0) {
    *solution = {problem.v_star, VecX(0)};
    summary.ending = SolveEnding::converged;
    summary.message = "no contacts";
    return summary;
  }
  if (!method.start()) {
    summary.message = "the Hessian of the sticking contacts is not positive definite in double precision";
    return summary;
  }
  method.run();
  solution->v = white.to_v(method.w());
  solution->gamma = method.gamma();
  return summary;
}

}  // namespace cupola
