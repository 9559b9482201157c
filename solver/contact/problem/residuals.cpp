#include "solver/contact/problem/residuals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "assembly/base/error.hpp"

namespace cupola {

double delassus_trace(const ContactProblem& p, int i) {
  double trace = 0.0;
  const auto add = [&](int k, const Mat63& D) {
    if (k != ContactProblem::kFixed) trace += (D.transpose() * p.M[k].llt().solve(D)).trace();
  };
  add(p.block_a[i], p.D_a[i]);
  add(p.block_b[i], p.D_b[i]);
  return trace;
}

namespace {

/// M^-1 norms of r = M (v - v_star) - D gamma per block: half the sum of their squares, and the largest.
struct MomentumError {
  double half_squared_norm = 0.0;
  double largest = 0.0;
};

MomentumError momentum_error(const ContactProblem& p, const ContactSolution& x) {
  const VecX impulse = generalized_impulse(p, x.gamma);
  MomentumError error;
  for (int k = 0; k < p.num_blocks(); ++k) {
    const Eigen::Matrix<double, 6, 1> r =
        p.M[k] * (x.v - p.v_star).segment<6>(6 * k) - impulse.segment<6>(6 * k);
    const double squared = p.M[k].llt().matrixL().solve(r).squaredNorm();
    error.half_squared_norm += 0.5 * squared;
    error.largest = std::max(error.largest, std::sqrt(squared));
    if (std::isnan(squared)) error.largest = squared;
  }
  return error;
}

/// The tangential compliance of a frictionless contact is unused.
bool is_rigid(const ContactLaw& law) {
  return law.e_n == 0.0 || (law.mu > 0.0 && law.e_t == 0.0);
}

/// Sets contact_law and rigid_contact_speed.
void measure_contact_law(const ContactProblem& p, const ContactSolution& x, const VecX& y0, FrictionLaw kind,
                         double reference_speed, Residuals* residuals) {
  double squared_error = 0.0;
  VecX expected(x.gamma.size());
  for (int i = 0; i < p.num_contacts(); ++i) {
    const Vec3 gamma = x.gamma.segment<3>(3 * i);
    Vec3 y = y0.segment<3>(3 * i);
    ContactLaw law = contact_law(p, i);
    const Vec3 elastic(law.e_n * gamma[0], law.e_t * gamma[1], law.e_t * gamma[2]);
    if (kind == FrictionLaw::coulomb) y[0] += law.mu * (y + elastic).tail<2>().norm();
    const bool rigid = is_rigid(law);
    if (rigid) {  // gamma - rho (y + E gamma) as the impulse of a contact of compliance 1/rho
      law.e_n = law.e_t = delassus_trace(p, i);
      y += elastic - law.e_n * gamma;
    }
    expected.segment<3>(3 * i) = contact_impulse(law, y);
    const double error = (gamma - expected.segment<3>(3 * i)).norm();
    squared_error += error * error;
    if (rigid) {
      residuals->rigid_contact_speed =
          std::max(residuals->rigid_contact_speed, law.e_n * error / reference_speed);
    }
  }
  if (squared_error == 0.0) return;
  residuals->contact_law = std::sqrt(squared_error) / std::max(x.gamma.norm(), expected.norm());
}

double contact_law_rounding(const ContactProblem& p, const ContactSolution& x) {
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  double squared = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    if (x.gamma.segment<3>(3 * i).isZero(0.0)) continue;  // open: gamma = 0 exactly
    double speed = p.b.segment<3>(3 * i).norm();
    const auto add = [&](int k, const Mat63& D) {
      if (k != ContactProblem::kFixed)
        speed += (D.cwiseAbs().transpose() * x.v.segment<6>(6 * k).cwiseAbs()).norm();
    };
    add(p.block_a[i], p.D_a[i]);
    add(p.block_b[i], p.D_b[i]);
    const ContactLaw law = contact_law(p, i);
    const double compliance = is_rigid(law) ? delassus_trace(p, i) : law.e_n;
    squared += std::pow(kEps * speed / compliance, 2);
  }
  return squared > 0.0 ? std::sqrt(squared) / x.gamma.norm() : 0.0;
}

double cone_violation(const ContactProblem& p, const VecX& gamma) {
  double violation = 0.0, largest = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    const double gamma_n = gamma[3 * i];
    const double gamma_t = gamma.segment<2>(3 * i + 1).norm();
    violation = std::max({violation, gamma_t - p.mu[i] * gamma_n, -gamma_n});
    largest = std::max(largest, std::abs(gamma_n));
  }
  return violation > 0.0 ? violation / std::max(largest, std::numeric_limits<double>::min()) : 0.0;
}

}  // namespace

double excess(const Residuals& residuals, double tolerance) {
  constexpr double kRoundingMargin = 16.0;  // for the sum of several rounding errors
  const double law =
      residuals.contact_law / std::max(tolerance, kRoundingMargin * residuals.contact_law_rounding);
  return std::max({residuals.momentum / tolerance, law, residuals.rigid_contact_speed / tolerance});
}

double smallest_compliance(const ContactProblem& p) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < p.num_contacts(); ++i) {
    smallest = std::min(smallest, p.E[3 * i]);
    if (p.mu[i] > 0.0) smallest = std::min(smallest, p.E[3 * i + 1]);
  }
  return smallest;
}

double contact_duality_gap(const ContactLaw& law, const Vec3& y, const Vec3& gamma) {
  const Vec3 gamma_v = contact_impulse(law, y);
  const double e_t = law.mu > 0.0 ? law.e_t : 0.0;
  const Vec3 difference = gamma - gamma_v;
  const double distance = 0.5 * difference.dot(Vec3(law.e_n, e_t, e_t).cwiseProduct(difference));
  switch (contact_region(law, y)) {  // gamma . z with z = y + E gamma(v), without cancellation
    case ContactRegion::separation:
      return distance + std::max(0.0, gamma.dot(y));
    case ContactRegion::stick:
      return distance;  // z = 0
    case ContactRegion::slip:
      break;
  }
  // z = |z_t| (mu, t) and gamma . z = |z_t| [(mu gamma_n - |gamma_t|) + |gamma_t| |t + gamma_t/|gamma_t||^2 / 2]
  constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();  // of |gamma_t| and mu gamma_n
  const double z_t = std::max(0.0, y.tail<2>().norm() - e_t * gamma_v.tail<2>().norm());
  const double gamma_t = gamma.tail<2>().norm();
  double inside = law.mu * gamma[0] - gamma_t;
  if (inside <= kRounding * law.mu * gamma[0]) inside = 0.0;
  if (gamma_t > 0.0 && y.tail<2>().norm() > 0.0)
    inside += 0.5 * gamma_t * (y.tail<2>().normalized() + gamma.tail<2>() / gamma_t).squaredNorm();
  return distance + z_t * inside;
}

double largest_unbalanced_impulse(const ContactProblem& problem, const ContactSolution& solution) {
  return momentum_error(problem, solution).largest;
}

double root_mean_mass(const ContactProblem& problem) {
  if (problem.num_blocks() == 0) return 1.0;
  double mass = 0.0;
  for (const Mat6& M : problem.M) mass += M.topLeftCorner<3, 3>().trace() / 3.0;
  return std::sqrt(mass / problem.num_blocks());
}

double duality_gap(const ContactProblem& problem, const ContactSolution& solution) {
  const VecX y = relative_velocity(problem, solution.v) + problem.b;
  double gap = momentum_error(problem, solution).half_squared_norm;
  for (int i = 0; i < problem.num_contacts(); ++i) {
    gap +=
        contact_duality_gap(contact_law(problem, i), y.segment<3>(3 * i), solution.gamma.segment<3>(3 * i));
  }
  return gap;
}

Residuals compute_residuals(const ContactProblem& problem, const ContactSolution& solution,
                            double reference_speed, FrictionLaw law) {
  CUPOLA_ASSERT(reference_speed > 0.0);
  CUPOLA_ASSERT(solution.gamma.size() == problem.b.size());
  const VecX y0 = relative_velocity(problem, solution.v) + problem.b;
  Residuals residuals;
  residuals.momentum =
      largest_unbalanced_impulse(problem, solution) / (root_mean_mass(problem) * reference_speed);
  measure_contact_law(problem, solution, y0, law, reference_speed, &residuals);
  residuals.contact_law_rounding = contact_law_rounding(problem, solution);
  residuals.cone_violation = cone_violation(problem, solution.gamma);

  constexpr double kRounding = 1e-14;  // |gamma_t| = mu gamma_n holds to a few eps
  const double min_E = smallest_compliance(problem);
  const double norm = solution.gamma.norm();
  if (law == FrictionLaw::associated && min_E > 0.0 && norm > 0.0 && residuals.cone_violation <= kRounding) {
    residuals.certificate.value = std::sqrt(2.0 * duality_gap(problem, solution) / min_E) / norm;
    residuals.certificate.bounds =
        "distance of the impulses from the exact ones of this contact problem, relative to their norm";
  } else {
    residuals.certificate.bounds = law == FrictionLaw::coulomb ? "Coulomb's law has no duality gap"
                                   : min_E == 0.0              ? "some compliance is zero"
                                   : norm == 0.0               ? "no contact is loaded"
                                                 : "some impulses lie outside their friction cones";
  }
  return residuals;
}

}  // namespace cupola
