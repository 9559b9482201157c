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
  constexpr double kRounding = 1e-9;  // of the sums; equal work and dissipation prove nothing
  // J: what cohesion and tension dissipate, and the most that crushing can where it has a limit
  double largest_delta = 0.0, largest_without_limit = 0.0, dissipated = 0.0, crushing = 0.0;
  for (int i = 0; i < problem.num_contacts(); ++i) {
    const ContactLaw law = contact_law(problem, i);
    const double slip = u.segment<2>(3 * i + 1).norm(), delta = law.mu * slip - u[3 * i];
    dissipated += law.dissipation(slip, -delta);
    largest_delta = std::max(largest_delta, delta);
    if (std::isfinite(law.strength.compression))
      crushing += law.strength.compression * std::max(0.0, delta);
    else
      largest_without_limit = std::max(largest_without_limit, delta);
  }
  // Two bounds: all contacts that approach supply the missing work, or those without a limit what crushing
  // cannot.
  const auto required = [&](double supplied, double delta) {
    if (!(work > (1.0 + kRounding) * supplied)) return 0.0;
    return delta > 0.0 ? (work - supplied) / (delta * problem.h) : std::numeric_limits<double>::infinity();
  };
  return std::max(required(dissipated, largest_delta),
                  required(dissipated + crushing, largest_without_limit));
}

double normal_force_sum(const ContactProblem& problem, const VecX& gamma) {
  double sum = 0.0;
  for (int i = 0; i < problem.num_contacts(); ++i) sum += gamma[3 * i];
  return sum / problem.h;
}

}  // namespace cupola
