#include "solver/conic/conic_problem.hpp"

#include <cmath>

namespace cupola {

ConicProblem with_multiplier(ConicProblem problem, const VecX& load, double cost) {
  problem.cost.setZero();
  problem.load_columns = load;
  problem.multiplier_cost = VecX::Constant(1, cost);
  problem.row_multipliers = MatX(1, 0);
  problem.strength_columns.clear();
  return problem;
}

ContactStrength strength_at(const ConicProblem& problem, int contact, const VecX& t) {
  ContactStrength strength;
  if (!problem.contacts.strength.empty()) strength = problem.contacts.strength[contact];
  for (size_t j = 0; j < problem.strength_columns.size(); ++j) {
    const ContactStrength& column = problem.strength_columns[j][contact];
    const double factor = t[static_cast<Eigen::Index>(j)];
    strength.tension += factor * column.tension;
    strength.cohesion += factor * column.cohesion;
    if (std::isfinite(strength.compression))
      strength.compression = std::isfinite(column.compression)
                                 ? strength.compression + factor * column.compression
                                 : column.compression;
  }
  return strength;
}

}  // namespace cupola
