#include "solver/contact/problem/second_order_cone.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {

double cone_determinant(const Vec3& x) {
  const double x_t = x.tail<2>().norm();
  return (x[0] - x_t) * (x[0] + x_t);
}

Vec3 jordan_product(const Vec3& x, const Vec3& y) {
  Vec3 product;
  product[0] = x.dot(y);
  product.tail<2>() = x[0] * y.tail<2>() + y[0] * x.tail<2>();
  return product;
}

Vec3 jordan_quotient(const Vec3& x, const Vec3& y) {
  Vec3 u;
  u[0] = (x[0] * y[0] - x.tail<2>().dot(y.tail<2>())) / cone_determinant(x);
  u.tail<2>() = (y.tail<2>() - u[0] * x.tail<2>()) / x[0];
  return u;
}

double step_to_boundary(const Vec3& x, const Vec3& d, double limit) {
  // Most contacts do not limit the step: no roots for them.
  if (const Vec3 end = x + limit * d; end[0] > 0.0 && end[0] * end[0] > end.tail<2>().squaredNorm())
    return limit;
  // x + t d leaves K at the smallest positive root of a t^2 + 2 b t + c, the determinant along the line.
  const double a = cone_determinant(d);
  const double b = x[0] * d[0] - x.tail<2>().dot(d.tail<2>());
  const double c = cone_determinant(x);
  // A step along the axis has a double root, which rounding may lose.
  if (d[0] < 0.0) limit = std::min(limit, -x[0] / d[0]);
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0 || (a >= 0.0 && b >= 0.0)) return limit;
  // The form of the root without cancellation: c / (-b + s) for b < 0, (-b - s) / a for b >= 0 > a.
  const double s = std::sqrt(discriminant);
  const double t = b < 0.0 ? c / (s - b) : (-b - s) / a;
  return std::clamp(t, 0.0, limit);
}

namespace {

/// Symmetric matrix with the eigenvectors (1, +-u) / sqrt(2) and the one across, and the eigenvalues f_plus,
/// f_minus and f_cross. u: unit direction of the tangential part of the scaling point.
Mat3 spectral(const Eigen::Vector2d& u, double f_plus, double f_minus, double f_cross) {
  const Eigen::Vector2d s(-u[1], u[0]);
  const double mean = 0.5 * (f_plus + f_minus), difference = 0.5 * (f_plus - f_minus);
  const Eigen::Matrix2d along = u * u.transpose(), across = s * s.transpose();
  Mat3 A;
  A(0, 0) = mean;
  A.topRightCorner<1, 2>() = difference * u.transpose();
  A.bottomLeftCorner<2, 1>() = difference * u;
  A.bottomRightCorner<2, 2>() = mean * along + f_cross * across;
  return A;
}

}  // namespace

NesterovTodd nesterov_todd(const Vec3& z, const Vec3& gamma) {
  const double det_z = std::sqrt(cone_determinant(z)), det_gamma = std::sqrt(cone_determinant(gamma));
  const Vec3 z_unit = z / det_z, gamma_unit = gamma / det_gamma;
  const double half = std::sqrt(0.5 * (1.0 + z_unit.dot(gamma_unit)));
  Vec3 w = z_unit;
  w[0] += gamma_unit[0];
  w.tail<2>() -= gamma_unit.tail<2>();
  w /= 2.0 * half;
  const double eta = std::sqrt(det_z / det_gamma);

  const double w_t = w.tail<2>().norm();
  const Eigen::Vector2d u = w_t > 0.0 ? Eigen::Vector2d(w.tail<2>() / w_t) : Eigen::Vector2d::UnitX();
  const double p = w[0] + w_t, q = 1.0 / p;  // q = w_0 - |w_t|, as det w = 1
  NesterovTodd scaling;
  scaling.W = spectral(u, eta * p, eta * q, eta);
  scaling.W_inverse = spectral(u, q / eta, p / eta, 1.0 / eta);
  scaling.W_squared = spectral(u, eta * eta * p * p, eta * eta * q * q, eta * eta);
  scaling.lambda = scaling.W * gamma;
  return scaling;
}

}  // namespace cupola
