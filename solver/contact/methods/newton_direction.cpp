#include "solver/contact/methods/newton_direction.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {

namespace {

/// Preconditioned conjugate gradients from d = 0; the norm of the last residual over that of the first, in
/// that of the preconditioner. What is infinite or not positive along the way ends them with 1.
template <class Multiply, class Precondition>
double conjugate_gradients(const Multiply& multiply, const Precondition& precondition, const VecX& rhs,
                           double forcing, int max_gradients, VecX* d, SolveSummary* summary) {
  VecX r = rhs;
  VecX z = precondition(r);
  VecX p = z;
  double rz = r.dot(z);
  const double first = rz;
  d->setZero(rhs.size());
  if (first == 0.0) return 0.0;  // nothing to solve
  for (int k = 0; k < max_gradients && rz > forcing * forcing * first; ++k) {
    ++summary->conjugate_gradients;
    const VecX Hp = multiply(p);
    const double alpha = rz / p.dot(Hp);
    if (!(alpha > 0.0)) return 1.0;  // lost positivity: the preconditioner is useless here
    *d += alpha * p;
    r -= alpha * Hp;
    z = precondition(r);
    if (!z.allFinite()) return 1.0;
    const double rz_new = std::max(0.0, r.dot(z));  // rounding may leave less than nothing
    p = z + (rz_new / rz) * p;
    rz = rz_new;
  }
  return d->allFinite() ? std::sqrt(rz / first) : 1.0;
}

}  // namespace

bool NewtonDirection::solve_directly(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                     VecX* d, SolveSummary* summary) {
  ++summary->factorizations;
  if (!factor_.factorize(pattern, H)) return false;
  *d = factor_.solve(rhs);
  return true;
}

bool NewtonDirection::solve_lagged(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                   double forcing, VecX* d, SolveSummary* summary) const {
  constexpr int kMaxGradients = 25;  // about the cost of a factorisation at 1,000 blocks
  if (!factor_.has_factor() || factor_.pattern() != pattern) return false;
  return conjugate_gradients([&](const VecX& x) { return multiply(pattern, H, x); },
                             [&](const VecX& r) { return factor_.solve(r); }, rhs, forcing, kMaxGradients, d,
                             summary) <= forcing;
}

bool NewtonDirection::solve_by_multigrid(const BlockPattern& pattern, const BlockMatrix& H,
                                         const RigidMotions& motions, const VecX& rhs, double forcing,
                                         VecX* d, SolveSummary* summary) {
  constexpr int kMaxGradients = 300;  // bricks of a dome take 15 to 90 for six digits
  constexpr double kOfUse = 0.1;
  Multigrid hierarchy;
  if (!hierarchy.build(pattern, H, motions)) return false;
  return conjugate_gradients([&](const VecX& x) { return hierarchy.multiply(x); },
                             [&](const VecX& r) { return hierarchy.cycle(r); }, rhs, forcing, kMaxGradients,
                             d, summary) <= std::max(kOfUse, forcing);
}

}  // namespace cupola
