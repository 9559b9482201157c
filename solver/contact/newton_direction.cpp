#include "solver/contact/newton_direction.hpp"

namespace cupola {

bool NewtonDirection::solve_directly(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                     VecX* d, SolveSummary* summary) {
  ++summary->factorizations;
  if (!factor_.factorize(pattern, H)) return false;
  *d = factor_.solve(rhs);
  return true;
}

bool NewtonDirection::solve_lagged(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                   double forcing, VecX* d, SolveSummary* summary) {
  if (factor_.has_factor() && factor_.pattern() == pattern &&
      conjugate_gradients(pattern, H, rhs, forcing, d, summary)) {
    return true;
  }
  return solve_directly(pattern, H, rhs, d, summary);
}

bool NewtonDirection::conjugate_gradients(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                          double forcing, VecX* d, SolveSummary* summary) const {
  VecX r = rhs;
  VecX z = factor_.solve(r);
  VecX p = z;
  double rz = r.dot(z);
  const double target = forcing * forcing * rz;
  d->setZero(rhs.size());
  for (int k = 0; k < kMaxConjugateGradients; ++k) {
    ++summary->conjugate_gradients;
    const VecX Hp = multiply(pattern, H, p);
    const double alpha = rz / p.dot(Hp);
    if (!(alpha > 0.0)) return false;  // lost positivity: the factor is useless here
    *d += alpha * p;
    r -= alpha * Hp;
    z = factor_.solve(r);
    const double rz_new = r.dot(z);
    if (!(rz_new > target)) return d->allFinite();
    p = z + (rz_new / rz) * p;
    rz = rz_new;
  }
  return false;
}

}  // namespace cupola
