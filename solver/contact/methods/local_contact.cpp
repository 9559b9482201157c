#include "solver/contact/methods/local_contact.hpp"

#include <limits>

#include <Eigen/LU>

#include "solver/contact/problem/cone.hpp"

namespace cupola {

namespace {

/// Without friction only the normal row is used.
Vec3 solve_frictionless(const Mat3& A, const Vec3& r) {
  return {std::max(0.0, -r[0] / A(0, 0)), 0.0, 0.0};
}

}  // namespace

Vec3 solve_local_contact(const Mat3& A, const Vec3& r, double mu, const Vec3& guess) {
  if (mu == 0.0) return solve_frictionless(A, r);
  // Row sums bound the eigenvalues (Gershgorin), so the projected step is a descent step.
  const Vec3 sums = A.cwiseAbs().rowwise().sum();
  const ContactLaw metric{sums[0], std::max(sums[1], sums[2]), mu};
  const Mat3 B = Vec3(metric.e_n, metric.e_t, metric.e_t).asDiagonal();

  constexpr int kMaxIterations = 100;
  Vec3 gamma = project_on_cone(metric, guess);
  double last_error = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMaxIterations; ++k) {
    const Vec3 y = A * gamma + r - B * gamma;
    Vec3 projected = contact_impulse(metric, y);
    const Vec3 F = gamma - projected;
    const double error = F.norm();
    if (error <= 1e-15 * projected.norm() || error == 0.0) return projected;
    if (error < 0.5 * last_error) {
      const Mat3 dF = Mat3::Identity() + contact_stiffness(metric, y) * (A - B);
      const Vec3 trial = gamma - dF.fullPivLu().solve(F);
      gamma = trial.allFinite() ? trial : projected;
    } else {
      gamma = projected;
    }
    last_error = error;
  }
  return contact_impulse(metric, Vec3(A * gamma + r - B * gamma));
}

}  // namespace cupola
