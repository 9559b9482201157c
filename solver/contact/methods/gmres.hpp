#pragma once

#include <functional>

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// GMRES with right preconditioning, from x = 0 and without restarts: reduces |rhs - A x| to `forcing` |rhs|
/// in at most max_iterations products. Saad, Schultz (1986), "GMRES: a generalized minimal residual algorithm
/// for solving nonsymmetric linear systems". Returns the number of iterations, or 0 if that many did not
/// suffice.
int gmres(const std::function<VecX(const VecX&)>& multiply,
          const std::function<VecX(const VecX&)>& precondition, const VecX& rhs, double forcing,
          int max_iterations, VecX* x);

}  // namespace cupola
