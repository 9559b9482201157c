#include "solver/contact/problem/kinematic_bound.hpp"

#include <algorithm>
#include <limits>

#include "assembly/base/error.hpp"
#include "solver/contact/problem/cone.hpp"

namespace cupola {

double required_normal_force(const ContactProblem& problem, const VecX& v) {
  CUPOLA_ASSERT(v.size() == 6 * problem.num_blocks());
  double work = 0.0;
  for (int k = 0; k < problem.num_blocks(); ++k)
    work += v.segment<6>(6 * k).dot(problem.M[k] * problem.v_star.segment<6>(6 * k));
  if (!(work > 0.0)) return 0.0;
  const VecX u = relative_velocity(problem, v);
  double largest_delta = 0.0, crushing = 0.0;  // N s m/s: the most that crushing can dissipate
  for (int i = 0; i < problem.num_contacts(); ++i) {
    const ContactLaw law = contact_law(problem, i);
    const double slip = u.segment<2>(3 * i + 1).norm(), delta = law.mu * slip - u[3 * i];
    work -= law.strength.cohesion * slip + law.tension_limit() * std::max(0.0, -delta);
    if (delta > 0.0) crushing += law.strength.compression * delta;
    largest_delta = std::max(largest_delta, delta);
  }
  if (!(work > 0.0)) return 0.0;
  if (work > crushing) return std::numeric_limits<double>::infinity();
  return largest_delta > 0.0 ? work / (largest_delta * problem.h) : std::numeric_limits<double>::infinity();
}

double normal_force_sum(const ContactProblem& problem, const VecX& gamma) {
  double sum = 0.0;
  for (int i = 0; i < problem.num_contacts(); ++i) sum += gamma[3 * i];
  return sum / problem.h;
}

}  // namespace cupola
