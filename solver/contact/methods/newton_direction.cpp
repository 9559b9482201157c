#include "solver/contact/methods/newton_direction.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/base/error.hpp"
#include "solver/runtime/interruption.hpp"

namespace cupola {

namespace {

/// Preconditioned conjugate gradients from d = 0. Returns the norm of the last residual over that of the
/// first, in the norm of the preconditioner (a small residual in stiff directions may hide a large error in
/// soft ones); 1 on breakdown (infinite values, loss of positive definiteness).
template <class Multiply, class Precondition>
double conjugate_gradients(const Multiply& multiply, const Precondition& precondition, const VecX& rhs,
                           double forcing, int max_iterations, VecX* d, SolveSummary* summary) {
  VecX r = rhs;
  VecX z = precondition(r);
  VecX p = z;
  double rz = r.dot(z);
  const double first = rz;
  d->setZero(rhs.size());
  if (first == 0.0) return 0.0;  // nothing to solve
  for (int k = 0; k < max_iterations && rz > forcing * forcing * first; ++k) {
    throw_if_interrupted();
    ++summary->conjugate_gradients;
    const VecX Hp = multiply(p);
    const double alpha = rz / p.dot(Hp);
    if (!(alpha > 0.0)) return 1.0;  // not positive definite in double precision
    *d += alpha * p;
    r -= alpha * Hp;
    z = precondition(r);
    if (!z.allFinite()) return 1.0;
    const double rz_new = std::max(0.0, r.dot(z));  // rounding may make it negative
    p = z + (rz_new / rz) * p;
    rz = rz_new;
  }
  return d->allFinite() ? std::sqrt(rz / first) : 1.0;
}

}  // namespace

bool NewtonDirection::solve_directly(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                     VecX* d, SolveSummary* summary) {
  CUPOLA_ASSERT(rhs.size() == 6 * pattern.num_blocks());
  ++summary->factorizations;
  if (!factor_.factorize(pattern, H)) return false;
  *d = factor_.solve(rhs);
  return true;
}

bool NewtonDirection::solve_lagged(const BlockPattern& pattern, const BlockMatrix& H, const VecX& rhs,
                                   double forcing, VecX* d, SolveSummary* summary) {
  constexpr int kMaxIterations = 25;  // about the cost of a factorisation at 1,000 blocks
  constexpr int kWorn = 12;           // chosen: in motions a factor of the last steps leads to 3 to 8
  if (!factor_.has_factor() || factor_.pattern() != pattern) return false;
  const int before = summary->conjugate_gradients;
  const bool solved = conjugate_gradients([&](const VecX& x) { return multiply(pattern, H, x); },
                                          [&](const VecX& r) { return factor_.solve_approximately(r); }, rhs,
                                          forcing, kMaxIterations, d, summary) <= forcing;
  // The next solves would take as many: a new factor pays within two or three of them.
  if (summary->conjugate_gradients - before > kWorn) factor_ = {};
  return solved;
}

bool NewtonDirection::solve_by_multigrid(const BlockPattern& pattern, const BlockMatrix& H,
                                         const RigidMotions& motions, const VecX& rhs, double forcing,
                                         VecX* d, SolveSummary* summary) {
  constexpr int kMaxIterations = 300;  // brick domes take 15 to 90 for six digits
  constexpr double kUsefulReduction = 0.1;
  constexpr double kWorn = 1.5;  // chosen: CG iterations per digit, over those with new prolongations
  const bool is_new = !multigrid_;
  if (is_new) multigrid_.emplace();
  if (!(is_new ? multigrid_->build(pattern, H, motions) : multigrid_->rebuild(pattern, H))) {
    multigrid_.reset();
    return !is_new && solve_by_multigrid(pattern, H, motions, rhs, forcing, d, summary);
  }
  const int before = summary->conjugate_gradients;
  const double reached = conjugate_gradients([&](const VecX& x) { return multiply(pattern, H, x); },
                                             [&](const VecX& r) { return multigrid_->cycle(r); }, rhs,
                                             forcing, kMaxIterations, d, summary);
  const double per_digit = (summary->conjugate_gradients - before) / -std::log10(std::max(reached, 1e-16));
  if (is_new) per_digit_ = per_digit;
  const bool useful = reached <= std::max(kUsefulReduction, forcing);
  if (!useful || !(per_digit <= kWorn * per_digit_)) multigrid_.reset();
  return useful || (!is_new && solve_by_multigrid(pattern, H, motions, rhs, forcing, d, summary));
}

}  // namespace cupola
