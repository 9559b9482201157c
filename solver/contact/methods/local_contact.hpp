#pragma once

#include "solver/contact/problem/cone.hpp"

namespace cupola {

/// One contact with a full 3x3 matrix: argmin over the admissible impulses (cone.hpp) of 1/2 gamma^T A gamma
/// + r^T gamma, A symmetric positive definite. The compliance in `law` is not used: it is part of A.
/// Semismooth Newton on the natural map gamma - P_B(gamma - B^-1 (A gamma + r)), B a diagonal metric that
/// majorises A. Falls back to a projected step where Newton does not reduce the error. Converges to rounding
/// in a few iterations.
Vec3 solve_local_contact(const Mat3& A, const Vec3& r, const ContactLaw& law, const Vec3& guess);

}  // namespace cupola
