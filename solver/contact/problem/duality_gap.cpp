#include "solver/contact/problem/duality_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "assembly/base/error.hpp"
#include "solver/runtime/ordered_sum.hpp"

namespace cupola {
namespace {

constexpr double kMachineEps = std::numeric_limits<double>::epsilon();
constexpr double kGapOperationsPerContact = 100.0, kGapOperationsPerBlock = 500.0;

/// Bounds of the rounding errors in the terms of the gap.
class RoundingBounds {
 public:
  RoundingBounds(const ContactProblem& problem, const ContactSolution& solution) : p_(problem), x_(solution) {
    add_momentum();
    add_contacts();
  }
  /// Bound of the resulting error of sqrt(2 gap) and of the distance of gamma from Y, sqrt(J).
  double total() const { return std::sqrt(squared_); }

 private:
  static Vec3 uncertainty(const ContactLaw& law, const Vec3& gamma);
  void add_momentum();
  void add_contacts();

  const ContactProblem& p_;
  const ContactSolution& x_;
  double squared_ = 0.0;
};

/// Rounding of an impulse, and its distance from the cone.
Vec3 RoundingBounds::uncertainty(const ContactLaw& law, const Vec3& gamma) {
  return 4.0 * kMachineEps * gamma.cwiseAbs() + Vec3::Constant(limit_excess(law, gamma));
}

/// |L^-1| times a bound of each component of the error of r = M (v - v_star) - D gamma.
void RoundingBounds::add_momentum() {
  std::vector<Vec6> error(static_cast<std::size_t>(p_.num_blocks()), Vec6::Zero());
  // Of the sum in one row: M (v - v_star) and the moment of an impulse, then three per contact.
  std::vector<int> terms(error.size(), 11);
  for (int i = 0; i < p_.num_contacts(); ++i)
    for (const int k : {p_.block_a[i], p_.block_b[i]})
      if (k != ContactProblem::kFixed) terms[k] += 3;
  const int nb = p_.num_blocks(), nc = p_.num_contacts();
  share_sums(kGapOperationsPerContact * nc, nb, [&](int first, int last) {
    const auto in_range = [&](int block) { return first <= block && block < last; };  // false for kFixed
    for (int i = 0; i < nc; ++i) {
      if (!in_range(p_.block_a[i]) && !in_range(p_.block_b[i])) continue;
      const Vec3 gamma = x_.gamma.segment<3>(3 * i);
      const Vec3 change = uncertainty(contact_law(p_, i), gamma);
      const auto add = [&](int k, const Lever& D) {
        if (in_range(k))
          error[k] += D.size_of_impulse(0.5 * kMachineEps * terms[k] * gamma.cwiseAbs() + change);
      };
      add(p_.block_a[i], p_.D_a[i]);
      add(p_.block_b[i], p_.D_b[i]);
    }
  });
  squared_ = sum_in_order(kGapOperationsPerBlock * nb, nb, squared_, [&](int k) {
    const Vec6 change = x_.v.segment<6>(6 * k) - p_.v_star.segment<6>(6 * k);
    const Vec6 whole = error[k] + 0.5 * kMachineEps * terms[k] * (p_.M[k].cwiseAbs() * change.cwiseAbs());
    const Mat6 L_inverse = p_.M[k].llt().matrixL().solve(Mat6::Identity());
    return (L_inverse.cwiseAbs() * whole).squaredNorm();
  });
}

/// The norm of E^-1 of the error of y = D^T v + b, and the norm of E of the error of gamma.
void RoundingBounds::add_contacts() {
  constexpr int kTerms = 16;  // of y: six per block, b, and the evaluation of the contact law
  const int nc = p_.num_contacts();
  squared_ = sum_in_order(kGapOperationsPerContact * nc, nc, squared_, [&](int i) {
    Vec3 speed = p_.b.segment<3>(3 * i).cwiseAbs();
    const auto add = [&](int k, const Lever& D) {
      if (k != ContactProblem::kFixed) speed += D.size_of_velocity(x_.v.segment<6>(6 * k));
    };
    add(p_.block_a[i], p_.D_a[i]);
    add(p_.block_b[i], p_.D_b[i]);
    const ContactLaw law = contact_law(p_, i);
    const Vec3 gamma = x_.gamma.segment<3>(3 * i);
    // An open contact whose gap exceeds the error stays open: its term of the gap is exactly zero.
    const Vec3 error = 0.5 * kMachineEps * kTerms * speed;
    const Vec3 y = relative_velocity(p_, i, x_.v) + p_.b.segment<3>(3 * i);
    const double opening = y[0] - law.mu * y.tail<2>().norm();
    if (gamma.isZero(0.0) && opening > error[0] + law.mu * error.tail<2>().norm()) return 0.0;
    const double e_t = law.carries_shear() ? law.e_t : law.e_n;
    const Vec3 E(law.e_n, e_t, e_t);
    return error.cwiseAbs2().cwiseQuotient(E).sum() +
           uncertainty(law, gamma).cwiseAbs2().cwiseProduct(E).sum();
  });
}

}  // namespace

double contact_duality_gap(const ContactLaw& law, const Vec3& y, const Vec3& gamma) {
  const Vec3 gamma_v = contact_impulse(law, y);
  const double e_t = law.carries_shear() ? law.e_t : 0.0;
  const Vec3 difference = gamma - gamma_v;
  const double distance = 0.5 * difference.dot(Vec3(law.e_n, e_t, e_t).cwiseProduct(difference));
  // The rest is (gamma - gamma(v)) . z with z = y + E gamma(v), without cancellation.
  const ContactRegion region = contact_region(law, y);
  if (region == ContactRegion::separation) return distance + std::max(0.0, gamma.dot(y));
  if (region == ContactRegion::stick) return distance;  // z = 0
  const bool slips = region != ContactRegion::yield;
  const double z_t = slips ? std::max(0.0, y.tail<2>().norm() - e_t * gamma_v.tail<2>().norm()) : 0.0;
  double rest = 0.0;
  if (region != ContactRegion::slip) {  // gamma(v)_n is at the pull, which opens the joint, or at the push
    const double yielding = y[0] + law.e_n * gamma_v[0] - law.mu * z_t;
    rest = std::max(0.0, yielding * (gamma[0] - gamma_v[0]));
  }
  if (!slips) return distance + rest;
  // |z_t| [(c + mu gamma_n - |gamma_t|) + |gamma_t| |t + gamma_t / |gamma_t||^2 / 2], z_t = |z_t| t
  constexpr double kRounding =
      8.0 * std::numeric_limits<double>::epsilon();  // of |gamma_t| and c + mu gamma_n
  const double gamma_t = gamma.tail<2>().norm(), limit = law.shear_limit(gamma[0]);
  double inside = limit - gamma_t;
  if (inside <= kRounding * limit) inside = 0.0;
  if (gamma_t > 0.0 && y.tail<2>().norm() > 0.0)
    inside += 0.5 * gamma_t * (y.tail<2>().normalized() + gamma.tail<2>() / gamma_t).squaredNorm();
  return distance + rest + z_t * inside;
}

double duality_gap(const ContactProblem& p, const ContactSolution& x) {
  const int nb = p.num_blocks(), nc = p.num_contacts();
  const VecX impulse = generalized_impulse(p, x.gamma);
  const double of_blocks = sum_in_order(kGapOperationsPerBlock * nb, nb, 0.0, [&](int k) {
    const Vec6 change = x.v.segment<6>(6 * k) - p.v_star.segment<6>(6 * k);
    const Vec6 r = p.M[k] * change - impulse.segment<6>(6 * k);
    return 0.5 * p.M[k].llt().matrixL().solve(r).squaredNorm();
  });
  return sum_in_order(kGapOperationsPerContact * nc, nc, of_blocks, [&](int i) {
    const Vec3 y = relative_velocity(p, i, x.v) + p.b.segment<3>(3 * i);
    return contact_duality_gap(contact_law(p, i), y, x.gamma.segment<3>(3 * i));
  });
}

double compliance_norm(const ContactProblem& problem, const VecX& gamma) {
  CUPOLA_ASSERT(gamma.size() == problem.E.size());
  double squared = 0.0;
  for (int i = 0; i < problem.num_contacts(); ++i) {
    const Vec3 g = gamma.segment<3>(3 * i);
    squared += problem.E[3 * i] * g[0] * g[0];
    if (contact_law(problem, i).carries_shear()) squared += problem.E[3 * i + 1] * g.tail<2>().squaredNorm();
  }
  return std::sqrt(squared);
}

double force_error_bound(const ContactProblem& problem, const ContactSolution& solution) {
  return std::sqrt(2.0 * duality_gap(problem, solution)) + RoundingBounds(problem, solution).total();
}

}  // namespace cupola
