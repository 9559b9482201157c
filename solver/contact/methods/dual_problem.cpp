#include "solver/contact/methods/dual_problem.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/duality_gap.hpp"
#include "solver/contact/problem/residuals.hpp"

namespace cupola {

VecX DualProblem::times(const VecX& gamma) const {
  return relative_velocity(white, generalized_impulse(white, gamma)) + white.given.E.cwiseProduct(gamma);
}

VecX DualProblem::project(const VecX& x) const {
  VecX result(x.size());
  for (int i = 0; i < white.given.num_contacts(); ++i) {
    const ContactLaw metric = contact_law(white.given, i, B[3 * i], B[3 * i + 1]);
    result.segment<3>(3 * i) = project_on_admissible(metric, x.segment<3>(3 * i));
  }
  return result;
}

VecX DualProblem::velocities(const VecX& gamma) const {
  return white.to_v(white.w_star + generalized_impulse(white, gamma));
}

DualProblem make_dual_problem(const ContactProblem& problem) {
  DualProblem dual{whiten(problem), {}, {}, ErrorMeasure::force_error};
  if (smallest_compliance(problem) == 0.0) dual.measure = ErrorMeasure::contact_law;
  dual.q = relative_velocity(problem, problem.v_star) + problem.b;
  dual.B = problem.E;
  const std::vector<Mat3> N = delassus_blocks(problem);
  for (int i = 0; i < problem.num_contacts(); ++i) {
    Vec3 diagonal = N[i].diagonal();
    diagonal[1] = diagonal[2] = 0.5 * (diagonal[1] + diagonal[2]);
    dual.B.segment<3>(3 * i) += diagonal;
  }
  return dual;
}

double dual_accuracy(const DualProblem& dual, const VecX& gamma, const VecX& g) {
  const ContactProblem& p = dual.white.given;
  CUPOLA_ASSERT(gamma.size() == p.b.size() && g.size() == p.b.size());
  const bool certifiable = dual.measure == ErrorMeasure::force_error;
  const VecX traces = first_rigid_contact(p) ? delassus_traces(p) : VecX();
  double sum = 0.0, squared_expected = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    const Vec3 gamma_i = gamma.segment<3>(3 * i), g_i = g.segment<3>(3 * i);
    ContactLaw law = contact_law(p, i);
    if (is_rigid(law)) law.e_n = law.e_t = traces[i];
    const Vec3 y = g_i - Vec3(law.e_n, law.e_t, law.e_t).cwiseProduct(gamma_i);
    if (certifiable) {
      sum += 2.0 * contact_duality_gap(law, y, gamma_i);
    } else {
      const Vec3 expected = contact_impulse(law, y);
      sum += (gamma_i - expected).squaredNorm();
      squared_expected += expected.squaredNorm();
    }
  }
  if (sum == 0.0) return 0.0;
  const double norm =
      certifiable ? compliance_norm(p, gamma) : std::max(gamma.norm(), std::sqrt(squared_expected));
  return norm > 0.0 ? std::sqrt(sum) / norm : 1.0;
}

VecX first_impulses(const DualProblem& dual, const ContactSolution& guess) {
  if (guess.gamma.size() != dual.q.size()) return VecX::Zero(dual.q.size());
  return dual.project(guess.gamma);
}

void finish_dual(const DualProblem& dual, double accuracy, const SolveOptions& options, bool stalled,
                 SolveSummary* summary) {
  const bool converged = accuracy <= options.tolerance;
  summary->ending = converged ? SolveEnding::converged
                    : stalled ? SolveEnding::stalled
                              : SolveEnding::max_iterations;
  if (!std::isfinite(accuracy)) summary->ending = SolveEnding::failed;
  summary->measure = dual.measure;
  summary->reached = accuracy;
  summary->message =
      fmt::format("{} {:.2e} {} tolerance {:.2e} after {}", to_string(dual.measure), accuracy,
                  converged ? "<=" : ">", options.tolerance, counted(summary->iterations, "iteration"));
}

}  // namespace cupola
