#include "solver/conic/conic_problem.hpp"

namespace cupola {

ConicProblem with_multiplier(ConicProblem problem, const VecX& load, double cost) {
  problem.cost.setZero();
  problem.load_columns = load;
  problem.multiplier_cost = VecX::Constant(1, cost);
  problem.row_multipliers = MatX(1, 0);
  return problem;
}

}  // namespace cupola
