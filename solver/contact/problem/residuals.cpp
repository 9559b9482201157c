#include "solver/contact/problem/residuals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/duality_gap.hpp"
#include "solver/runtime/ordered_sum.hpp"

namespace cupola {

namespace {

/// Floating-point operations of a pass over so many contacts.
double pass_over(int contacts) {
  return 100.0 * contacts;
}

}  // namespace

std::vector<Mat6> inverse_masses(const ContactProblem& p) {
  std::vector<Mat6> inverse(p.M.size());
  for (size_t k = 0; k < p.M.size(); ++k) inverse[k] = p.M[k].llt().solve(Mat6::Identity());
  return inverse;
}

std::vector<Mat3> delassus_blocks(const ContactProblem& p) {
  const std::vector<Mat6> inverse = inverse_masses(p);
  std::vector<Mat3> N(p.num_contacts(), Mat3::Zero());
  for (int i = 0; i < p.num_contacts(); ++i) {
    const auto add = [&](int k) {
      const Mat63 D = contact_columns(p, i, k);
      N[i] += D.transpose() * inverse[k] * D;
    };
    const int a = p.block_a[i], b = p.block_b[i];
    if (a != ContactProblem::kFixed) add(a);
    if (b != ContactProblem::kFixed && b != a) add(b);
  }
  return N;
}

VecX delassus_traces(const ContactProblem& p) {
  const std::vector<Mat3> N = delassus_blocks(p);
  VecX traces(p.num_contacts());
  for (int i = 0; i < p.num_contacts(); ++i) traces[i] = N[i].trace();
  return traces;
}

namespace {

/// Metrics of the projections of rigid contacts (nc); empty if there are none.
VecX rigid_metrics(const ContactProblem& p) {
  return first_rigid_contact(p) ? delassus_traces(p) : VecX();
}

/// The impulse that the law of a contact gives, and the metric of the projection, 0 if it is not rigid.
struct ExpectedImpulse {
  Vec3 gamma;
  double rigid_metric;
};
ExpectedImpulse expected_impulse(const ContactProblem& p, const ContactSolution& x, const FlowRule& kind,
                                 const VecX& rigid_metrics, int i) {
  const Vec3 gamma = x.gamma.segment<3>(3 * i);
  Vec3 y = relative_velocity(p, i, x.v) + p.b.segment<3>(3 * i);
  ContactLaw law = contact_law(p, i);
  const Vec3 elastic(law.e_n * gamma[0], law.e_t * gamma[1], law.e_t * gamma[2]);
  if (!kind.is_associated()) y[0] += (1.0 - kind.dilatancy) * law.mu * (y + elastic).tail<2>().norm();
  double rigid_metric = 0.0;
  if (is_rigid(law)) {  // gamma - rho (y + E gamma) as the impulse of a contact of compliance 1/rho
    rigid_metric = law.e_n = law.e_t = rigid_metrics[i];
    y += elastic - law.e_n * gamma;
  }
  return {contact_impulse(law, y), rigid_metric};
}

struct LawErrors {
  double squared_error = 0.0, squared_expected = 0.0;
  double speed = 0.0;  ///< of rigid contacts, largest
  LawErrors& operator+=(const LawErrors& other) {
    squared_error += other.squared_error;
    squared_expected += other.squared_expected;
    speed = std::max(speed, other.speed);
    return *this;
  }
};

/// Sets contact_law and rigid_contact_speed.
void measure_contact_law(const ContactProblem& p, const ContactSolution& x, const FlowRule& kind,
                         const VecX& rigid_metrics, double reference_speed, Residuals* residuals) {
  const int nc = p.num_contacts();
  const LawErrors sum = sum_in_order(pass_over(nc), nc, LawErrors{}, [&](int i) {
    const auto [expected, rigid_metric] = expected_impulse(p, x, kind, rigid_metrics, i);
    const double error = (x.gamma.segment<3>(3 * i) - expected).norm();
    return LawErrors{error * error, expected.squaredNorm(), rigid_metric * error / reference_speed};
  });
  residuals->rigid_contact_speed = sum.speed;
  if (sum.squared_error == 0.0) return;
  residuals->contact_law =
      std::sqrt(sum.squared_error) / std::max(x.gamma.norm(), std::sqrt(sum.squared_expected));
}

double contact_law_rounding(const ContactProblem& p, const ContactSolution& x, const VecX& rigid_metrics) {
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  constexpr double kInside = 1.0 - 1e-12;  // in slip the shear is at its limit to rounding
  const int nc = p.num_contacts();
  const double squared = sum_in_order(pass_over(nc), nc, 0.0, [&](int i) {
    const Vec3 gamma = x.gamma.segment<3>(3 * i);
    if (gamma.isZero(0.0)) return 0.0;  // open: gamma = 0 exactly
    double speed = p.b.segment<3>(3 * i).norm();
    const auto add = [&](int k, const Lever& D) {
      if (k != ContactProblem::kFixed) speed += D.size_of_velocity(x.v.segment<6>(6 * k)).norm();
    };
    add(p.block_a[i], p.D_a[i]);
    add(p.block_b[i], p.D_b[i]);
    const ContactLaw law = contact_law(p, i);
    const bool sticks = gamma.tail<2>().norm() < kInside * law.shear_limit(gamma[0]);
    const double compliance = is_rigid(law) ? rigid_metrics[i]
                              : sticks      ? std::min(law.e_n, law.e_t)
                                            : law.e_n;
    return std::pow(kEps * speed / compliance, 2);
  });
  return squared > 0.0 ? std::sqrt(squared) / x.gamma.norm() : 0.0;
}

double cone_violation(const ContactProblem& p, const VecX& gamma) {
  double violation = 0.0, largest = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    violation = std::max(violation, limit_excess(contact_law(p, i), gamma.segment<3>(3 * i)));
    largest = std::max(largest, std::abs(gamma[3 * i]));
  }
  return violation > 0.0 ? violation / std::max(largest, std::numeric_limits<double>::min()) : 0.0;
}

/// Bound of the relative error of the impulses, or why there is none.
ForceCertificate certificate(const ContactProblem& problem, const ContactSolution& solution,
                             const FlowRule& law, double cone_violation) {
  constexpr double kRounding = 1e-14;  // |gamma_t| = mu gamma_n holds to a few eps
  if (!law.is_associated())
    return {{}, "a non-associated law (Coulomb's) is not a minimisation and has no duality gap"};
  if (smallest_compliance(problem) == 0.0) return {{}, "some compliance is zero"};
  if (!(cone_violation <= kRounding)) return {{}, "some impulses exceed the limits of their joints"};
  const double norm = compliance_norm(problem, solution.gamma);
  if (!(norm > 0.0)) return {{}, "no contact is loaded"};
  const double bound = force_error_bound(problem, solution) / norm;
  if (!std::isfinite(bound)) return {{}, "the solution is too far from an equilibrium to bound its error"};
  return {bound,
          "the distance of the impulses of a step from the exact solution of its contact problem, in the "
          "norm of the compliance, relative to the impulses"};
}

/// Tolerance of contact_law: raised to what rounding permits.
double law_tolerance(const Residuals& residuals, double tolerance) {
  constexpr double kMargin = 16.0;  // for the sum of several rounding errors
  // A block that slides down an incline on a compliance of 1e-12 of its Delassus block moves as the closed
  // form to 1e-12 with residuals of 1e-4 from rounding alone. Above 1e-3, the forces that are printed could
  // be wrong.
  constexpr double kLargest = 1e-3;
  return std::max(tolerance, std::min(kMargin * residuals.contact_law_rounding, kLargest));
}

}  // namespace

VecX contact_law_errors(const ContactProblem& problem, const ContactSolution& solution, const FlowRule& law) {
  const int nc = problem.num_contacts();
  const VecX metrics = rigid_metrics(problem);
  VecX errors(nc);
  share_sums(pass_over(nc), nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const Vec3 expected = expected_impulse(problem, solution, law, metrics, i).gamma;
      errors[i] = (solution.gamma.segment<3>(3 * i) - expected).norm();
    }
  });
  return errors;
}

double largest_residual(const Residuals& residuals) {
  return std::max({residuals.momentum, residuals.contact_law, residuals.rigid_contact_speed});
}

double excess(const Residuals& residuals, double tolerance) {
  return std::max({residuals.momentum / tolerance,
                   residuals.contact_law / law_tolerance(residuals, tolerance),
                   residuals.rigid_contact_speed / tolerance});
}

std::string residuals_text(const Residuals& residuals, double tolerance) {
  std::string text = fmt::format("momentum residual {:.2e}, contact-law residual {:.2e}", residuals.momentum,
                                 residuals.contact_law);
  if (residuals.rigid_contact_speed > 0.0)
    text += fmt::format(", speed of rigid contacts {:.2e}", residuals.rigid_contact_speed);
  text += fmt::format(", tolerance {:.2e}", tolerance);
  if (residuals.contact_law > tolerance && residuals.contact_law <= law_tolerance(residuals, tolerance))
    text += fmt::format(" (contact law: {:.2e}, because rounding of the velocities causes up to that much)",
                        law_tolerance(residuals, tolerance));
  return text;
}

double smallest_compliance(const ContactProblem& p) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < p.num_contacts(); ++i) {
    smallest = std::min(smallest, p.E[3 * i]);
    if (contact_law(p, i).carries_shear()) smallest = std::min(smallest, p.E[3 * i + 1]);
  }
  return smallest;
}

ForcesUnique forces_unique(const ContactProblem& problem, const FlowRule& law) {
  if (smallest_compliance(problem) == 0.0)
    return {false, "some joint compliance is zero, so that many forces balance the same loads"};
  if (!law.is_associated() && problem.mu.size() > 0 && problem.mu.maxCoeff() > 0.0)
    return {false, "under a non-associated law (Coulomb's) a contact problem can have several solutions"};
  return {true, "associated law with a compliance above zero at every contact"};
}

double momentum_residual(const ContactProblem& p, const ContactSolution& x, double reference_speed) {
  const VecX impulse = generalized_impulse(p, x.gamma);
  double largest = 0.0;
  for (int k = 0; k < p.num_blocks(); ++k) {
    const Eigen::Matrix<double, 6, 1> r =
        p.M[k] * (x.v - p.v_star).segment<6>(6 * k) - impulse.segment<6>(6 * k);
    const double norm = p.M[k].llt().matrixL().solve(r).norm();
    if (std::isnan(norm)) return norm;
    largest = std::max(largest, norm);
  }
  return largest / (root_mean_mass(p) * reference_speed);
}

double root_mean_mass(const ContactProblem& problem) {
  if (problem.num_blocks() == 0) return 1.0;
  double mass = 0.0;
  for (const Mat6& M : problem.M) mass += M.topLeftCorner<3, 3>().trace() / 3.0;
  return std::sqrt(mass / problem.num_blocks());
}

Residuals compute_residuals(const ContactProblem& problem, const ContactSolution& solution,
                            double reference_speed, const FlowRule& law) {
  CUPOLA_ASSERT(reference_speed > 0.0);
  CUPOLA_ASSERT(solution.gamma.size() == problem.b.size());
  constexpr double kExactLaw = 1e-14;  // below any tolerance, which need not be raised then
  Residuals residuals;
  residuals.momentum = momentum_residual(problem, solution, reference_speed);
  const VecX metrics = rigid_metrics(problem);
  measure_contact_law(problem, solution, law, metrics, reference_speed, &residuals);
  if (residuals.contact_law > kExactLaw)
    residuals.contact_law_rounding = contact_law_rounding(problem, solution, metrics);
  residuals.cone_violation = cone_violation(problem, solution.gamma);
  residuals.certificate = certificate(problem, solution, law, residuals.cone_violation);
  return residuals;
}

}  // namespace cupola
