#include "solver/contact/problem/cone.hpp"

#include <algorithm>

namespace cupola {

ContactRegion contact_region(const ContactLaw& law, const Vec3& y) {
  const double y_t = y.tail<2>().norm();
  if (y[0] >= law.dilatancy * law.mu * y_t) return ContactRegion::separation;
  if (law.mu > 0.0 && y_t * law.e_n <= -law.mu * y[0] * law.e_t) return ContactRegion::stick;
  return ContactRegion::slip;
}

namespace {

/// Unit vector along y_t. Arbitrary at y_t = 0, where its factor vanishes.
Eigen::Vector2d slip_direction(const Vec3& y) {
  const double y_t = y.tail<2>().norm();
  return y_t > 0.0 ? Eigen::Vector2d(y.tail<2>() / y_t) : Eigen::Vector2d::UnitX();
}

/// Normal impulse of a slipping contact.
double slip_impulse(const ContactLaw& law, const Vec3& y) {
  const double theta_mu = law.dilatancy * law.mu;
  return (theta_mu * y.tail<2>().norm() - y[0]) / (law.e_n + theta_mu * law.mu * law.e_t);
}

/// At mu = 0 the tangential compliance is unused and may be NaN or infinite.
ContactLaw without_unused_compliance(ContactLaw law) {
  if (law.mu == 0.0) law.e_t = 0.0;
  return law;
}

}  // namespace

Vec3 contact_impulse(const ContactLaw& given, const Vec3& y) {
  const ContactLaw law = without_unused_compliance(given);
  switch (contact_region(law, y)) {
    case ContactRegion::separation:
      return Vec3::Zero();
    case ContactRegion::stick:
      return {-y[0] / law.e_n, -y[1] / law.e_t, -y[2] / law.e_t};
    case ContactRegion::slip:
      break;
  }
  const double a = slip_impulse(law, y);
  const Eigen::Vector2d t = slip_direction(y);
  return {a, -law.mu * a * t[0], -law.mu * a * t[1]};
}

Mat3 contact_stiffness(const ContactLaw& given, const Vec3& y) {
  const ContactLaw law = without_unused_compliance(given);
  Mat3 G = Mat3::Zero();
  switch (contact_region(law, y)) {
    case ContactRegion::separation:
      return G;
    case ContactRegion::stick:
      G.diagonal() << 1.0 / law.e_n, 1.0 / law.e_t, 1.0 / law.e_t;
      return G;
    case ContactRegion::slip:
      break;
  }
  const Eigen::Vector2d t = slip_direction(y);
  const Vec3 ray(1.0, -law.mu * t[0], -law.mu * t[1]);  // gamma = a ray
  const double theta_mu = law.dilatancy * law.mu;
  const Vec3 opening(1.0, -theta_mu * t[0], -theta_mu * t[1]);  // a is proportional to -opening . y
  G.noalias() = ray * opening.transpose() / (law.e_n + theta_mu * law.mu * law.e_t);
  const double y_t = y.tail<2>().norm();
  if (y_t > 0.0) {  // derivative of the direction of the ray
    const Eigen::Vector2d s(-t[1], t[0]);
    const Eigen::Matrix2d across = s * s.transpose();
    G.bottomRightCorner<2, 2>() += (law.mu * slip_impulse(law, y) / y_t) * across;
  }
  return G;
}

Vec3 project_on_cone(const ContactLaw& metric, const Vec3& x) {
  return contact_impulse(metric, Vec3(-metric.e_n * x[0], -metric.e_t * x[1], -metric.e_t * x[2]));
}

}  // namespace cupola
