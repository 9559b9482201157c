#include "solver/contact/problem/kinematic_bound.hpp"

#include <algorithm>
#include <limits>

#include "assembly/base/error.hpp"

namespace cupola {

double required_normal_force(const ContactProblem& problem, const VecX& v) {
  CUPOLA_ASSERT(v.size() == 6 * problem.num_blocks());
  double work = 0.0;
  for (int k = 0; k < problem.num_blocks(); ++k)
    work += v.segment<6>(6 * k).dot(problem.M[k] * problem.v_star.segment<6>(6 * k));
  if (!(work > 0.0)) return 0.0;
  const VecX u = relative_velocity(problem, v);
  double largest_delta = 0.0;
  for (int i = 0; i < problem.num_contacts(); ++i)
    largest_delta = std::max(largest_delta, problem.mu[i] * u.segment<2>(3 * i + 1).norm() - u[3 * i]);
  return largest_delta > 0.0 ? work / (largest_delta * problem.h) : std::numeric_limits<double>::infinity();
}

double normal_force_sum(const ContactProblem& problem, const VecX& gamma) {
  double sum = 0.0;
  for (int i = 0; i < problem.num_contacts(); ++i) sum += gamma[3 * i];
  return sum / problem.h;
}

}  // namespace cupola
