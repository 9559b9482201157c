#include "solver/contact/newton_direction.hpp"

#include <algorithm>

namespace cupola {

bool NewtonDirection::solve_directly(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                     VecX* d, SolveSummary* summary) {
  ++summary->factorizations;
  if (!factor_.factorize(pattern, H)) return false;
  *d = factor_.solve(rhs);
  return true;
}

int NewtonDirection::affordable_gradients() const {
  constexpr int kWorthTrying = 8;
  const int affordable = static_cast<int>(0.8 * factor_.solves_per_factorization());
  return affordable < kWorthTrying ? 0 : std::min(affordable, kMaxConjugateGradients);
}

bool NewtonDirection::solve_lagged(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                   double forcing, int max_gradients, VecX* d, SolveSummary* summary) const {
  if (!factor_.has_factor() || factor_.pattern() != pattern) return false;
  VecX r = rhs;
  VecX z = factor_.solve(r);
  VecX p = z;
  double rz = r.dot(z);
  const double target = forcing * forcing * rz;
  d->setZero(rhs.size());
  for (int k = 0; k < max_gradients; ++k) {
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
