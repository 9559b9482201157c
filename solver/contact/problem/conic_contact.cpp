#include "solver/contact/problem/conic_contact.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace cupola {

ConicContact::ConicContact(double mu, const Vec3& compliance)
    : frictionless(mu == 0.0), to_cone(frictionless ? Vec3(1, 0, 0) : Vec3(mu, 1, 1)), E(compliance) {}

void ConicContact::scale() {
  if (frictionless) {
    const double w = std::sqrt(z[0] / gamma[0]);
    nt.W = Vec3(w, 0, 0).asDiagonal();
    nt.W_inverse = Vec3(1 / w, 0, 0).asDiagonal();
    nt.W_squared = Vec3(w * w, 0, 0).asDiagonal();
    nt.lambda = Vec3(std::sqrt(z[0] * gamma[0]), 0, 0);
    G = Vec3(1.0 / (w * w + E[0]), 0, 0).asDiagonal();
    return;
  }
  nt = nesterov_todd(z, gamma);
  if (E.isZero(0.0)) {  // the inverse of W is known more accurately than A is inverted
    const Mat3 W_inverse = to_cone.cwiseInverse().asDiagonal() * nt.W_inverse;
    G = W_inverse * W_inverse.transpose();
    return;
  }
  Mat3 A = to_cone.asDiagonal() * nt.W_squared * to_cone.asDiagonal();
  A.diagonal() += E;
  G = A.llt().solve(Mat3::Identity());
}

Vec3 ConicContact::d(double target, const Vec3& affine_gamma, const Vec3& affine_z) const {
  const Vec3 a = nt.W_inverse * affine_z, c = nt.W * affine_gamma;
  if (frictionless) return Vec3((target - nt.lambda[0] * nt.lambda[0] - a[0] * c[0]) / nt.lambda[0], 0, 0);
  return jordan_quotient(nt.lambda, Vec3(target * Vec3::UnitX() - jordan_product(a, c))) - nt.lambda;
}

double ConicContact::largest_step(const Vec3& d_gamma, const Vec3& d_z, double limit) const {
  if (!frictionless) return step_to_boundary(z, d_z, step_to_boundary(gamma, d_gamma, limit));
  if (d_gamma[0] < 0.0) limit = std::min(limit, -gamma[0] / d_gamma[0]);
  if (d_z[0] < 0.0) limit = std::min(limit, -z[0] / d_z[0]);
  return limit;
}

Mat3 ConicContact::compliance() const {
  return to_cone.asDiagonal() * nt.W_squared * to_cone.asDiagonal();
}

Vec3 ConicContact::force() const {
  return frictionless ? Vec3(gamma[0], 0, 0) : gamma.cwiseQuotient(to_cone);
}

}  // namespace cupola
