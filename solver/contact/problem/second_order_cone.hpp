#pragma once

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// Arithmetic of the cone K = { x : x_0 >= |(x_1, x_2)| } and its Jordan algebra with the identity
/// e = (1, 0, 0), for the interior point method. x is interior if x_0 > |(x_1, x_2)|.

/// x_0^2 - |x_t|^2, accurate where x is close to the boundary.
double cone_determinant(const Vec3& x);

/// Jordan product x o y = (x . y, x_0 y_t + y_0 x_t).
Vec3 jordan_product(const Vec3& x, const Vec3& y);

/// u that solves x o u = y, for interior x.
Vec3 jordan_quotient(const Vec3& x, const Vec3& y);

/// Largest t in [0, limit] with x + t d in K, for interior x.
double step_to_boundary(const Vec3& x, const Vec3& d, double limit);

/// Nesterov-Todd scaling of the interior pair (z, gamma): symmetric W with W gamma = W^-1 z = lambda.
struct NesterovTodd {
  Mat3 W, W_inverse;
  Mat3 W_squared;  ///< maps gamma to z
  Vec3 lambda;
};
NesterovTodd nesterov_todd(const Vec3& z, const Vec3& gamma);

}  // namespace cupola
