#include "solver/contact/methods/local_contact.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/LU>

#include "solver/contact/problem/cone.hpp"

namespace cupola {

namespace {

/// Without shear only the normal row is used.
Vec3 solve_normal(const Mat3& A, const Vec3& r, const ContactStrength& strength) {
  return {std::clamp(-r[0] / A(0, 0), -strength.tension, strength.compression), 0.0, 0.0};
}

}  // namespace

Vec3 solve_local_contact(const Mat3& A, const Vec3& r, const ContactLaw& law, const Vec3& guess) {
  if (!law.carries_shear()) return solve_normal(A, r, law.strength);
  // Row sums bound the eigenvalues (Gershgorin), so the projected step is a descent step.
  const Vec3 sums = A.cwiseAbs().rowwise().sum();
  ContactLaw metric = law;
  metric.e_n = sums[0];
  metric.e_t = std::max(sums[1], sums[2]);
  const Mat3 B = Vec3(metric.e_n, metric.e_t, metric.e_t).asDiagonal();

  constexpr int kMaxIterations = 100;
  Vec3 gamma = project_on_admissible(metric, guess);
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
