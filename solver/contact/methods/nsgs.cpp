#include "solver/contact/methods/nsgs.hpp"

#include "solver/contact/methods/dual_problem.hpp"
#include "solver/contact/methods/local_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/runtime/interruption.hpp"
#include "solver/runtime/iteration_log.hpp"

namespace cupola {

namespace {

/// N_ii + E_i of every contact.
std::vector<Mat3> local_matrices(const ContactProblem& p) {
  std::vector<Mat3> A = delassus_blocks(p);
  for (int i = 0; i < p.num_contacts(); ++i) A[i].diagonal() += p.E.segment<3>(3 * i);
  return A;
}

/// One sweep over the contacts. Keeps v = v_star + M^-1 D gamma.
void sweep(const ContactProblem& p, const std::vector<Mat6>& M_inverse, const std::vector<Mat3>& A,
           VecX* gamma, VecX* v) {
  for (int i = 0; i < p.num_contacts(); ++i) {
    const int a = p.block_a[i], b = p.block_b[i];
    const Vec3 old = gamma->segment<3>(3 * i);
    const Vec3 y =
        relative_velocity(p, i, *v) + p.b.segment<3>(3 * i) + p.E.segment<3>(3 * i).cwiseProduct(old);
    const Vec3 fresh = solve_local_contact(A[i], y - A[i] * old, contact_law(p, i), old);
    const Vec3 change = fresh - old;
    if (change.isZero(0.0)) continue;
    gamma->segment<3>(3 * i) = fresh;
    if (a != ContactProblem::kFixed) v->segment<6>(6 * a) += M_inverse[a] * (p.D_a[i].matrix() * change);
    if (b != ContactProblem::kFixed) v->segment<6>(6 * b) += M_inverse[b] * (p.D_b[i].matrix() * change);
  }
}

}  // namespace

SolveSummary solve_nsgs(const ContactProblem& problem, const SolveOptions& options,
                        ContactSolution* solution) {
  constexpr int kSweepsPerCheck = 10;
  options.validate();
  SolveSummary summary;
  if (summary.message = problem.defect(); !summary.message.empty()) return summary;
  const int max_iterations = options.max_iterations.value_or(5000);

  const DualProblem dual = make_dual_problem(problem);
  const std::vector<Mat3> A = local_matrices(problem);
  const std::vector<Mat6> M_inverse = inverse_masses(problem);
  VecX gamma = first_impulses(dual, *solution);
  double accuracy = dual_accuracy(dual, gamma, dual.times(gamma) + dual.q);
  summary.residual_history.push_back(accuracy);
  while (accuracy > options.tolerance && summary.iterations < max_iterations) {
    throw_if_interrupted();
    report_iteration("nsgs", summary.iterations, accuracy, options.tolerance);
    VecX v = dual.velocities(gamma);  // recomputed to remove the rounding of the updates
    for (int k = 0; k < kSweepsPerCheck && summary.iterations < max_iterations; ++k, ++summary.iterations) {
      sweep(problem, M_inverse, A, &gamma, &v);
    }
    accuracy = dual_accuracy(dual, gamma, dual.times(gamma) + dual.q);
    summary.residual_history.push_back(accuracy);
  }
  *solution = {dual.velocities(gamma), gamma};
  finish_dual(dual, accuracy, options, false, &summary);
  return summary;
}

}  // namespace cupola
