#include "solver/contact/problem/cone.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {

namespace {

/// Unit vector along y_t. Arbitrary at y_t = 0, where its factor vanishes.
Eigen::Vector2d slip_direction(const Vec3& y, double y_t) {
  return y_t > 0.0 ? Eigen::Vector2d(y.tail<2>() / y_t) : Eigen::Vector2d::UnitX();
}

/// The tangential compliance of a contact without shear is unused and may be NaN or infinite.
ContactLaw without_unused_compliance(ContactLaw law) {
  if (!law.carries_shear()) law.e_t = 0.0;
  return law;
}

struct Evaluation {
  ContactRegion region;
  double normal;  ///< gamma_n, N s
  double y_t;     ///< |y_t|
};

bool is_dry(const ContactStrength& strength) {
  return strength.tension == 0.0 && strength.cohesion == 0.0 && std::isinf(strength.compression);
}

/// evaluate() without strength, by far the most frequent case, to the same bits.
Evaluation evaluate_dry(const ContactLaw& law, const Vec3& y, double y_t) {
  const bool opens = y[0] >= 0.0;
  if (law.mu == 0.0 || y_t * law.e_n <= law.mu * std::max(-y[0], 0.0) * law.e_t) {
    if (opens) return {ContactRegion::separation, 0.0, y_t};
    if (law.mu > 0.0) return {ContactRegion::stick, -y[0] / law.e_n, y_t};
  }
  const double theta_mu = law.dilatancy * law.mu;
  const double n = (theta_mu * y_t - y[0]) / (law.e_n + theta_mu * law.mu * law.e_t);
  if (n <= 0.0) return {ContactRegion::separation, 0.0, y_t};
  return {ContactRegion::slip, n, y_t};
}

/// `law` without unused compliance.
Evaluation evaluate(const ContactLaw& law, const Vec3& y) {
  const double y_t = y.tail<2>().norm();
  if (is_dry(law.strength)) return evaluate_dry(law, y, y_t);
  const double tension = law.tension_limit(), compression = law.strength.compression;
  const bool no_impulse = tension == 0.0 && law.strength.cohesion == 0.0;
  const bool is_pulled = y[0] >= tension * law.e_n, is_crushed = -y[0] >= compression * law.e_n;
  const auto at_limit = [&](bool pulled, ContactRegion region) -> Evaluation {
    if (pulled && no_impulse) return {ContactRegion::separation, 0.0, y_t};
    return {region, pulled ? -tension : compression, y_t};
  };
  if (law.carries_shear()) {
    const double normal = std::clamp(-y[0], -tension * law.e_n, compression * law.e_n);
    if (y_t * law.e_n <= (law.strength.cohesion * law.e_n + law.mu * normal) * law.e_t) {
      if (is_pulled || is_crushed) return at_limit(is_pulled, ContactRegion::yield);
      return {ContactRegion::stick, -y[0] / law.e_n, y_t};
    }
  } else if (is_pulled || is_crushed) {
    return at_limit(is_pulled, ContactRegion::yield);
  }
  const double theta_mu = law.dilatancy * law.mu;
  const double n =
      (theta_mu * (y_t - law.e_t * law.strength.cohesion) - y[0]) / (law.e_n + theta_mu * law.mu * law.e_t);
  if (n <= -tension || n >= compression) return at_limit(n <= -tension, ContactRegion::yield_and_slip);
  return {ContactRegion::slip, n, y_t};
}

Vec3 impulse_of(const Evaluation& evaluation, const ContactLaw& law, const Vec3& y) {
  const auto [region, n, y_t] = evaluation;
  if (region == ContactRegion::separation) return Vec3::Zero();
  if (region == ContactRegion::stick || region == ContactRegion::yield)
    return law.carries_shear() ? Vec3(n, -y[1] / law.e_t, -y[2] / law.e_t) : Vec3(n, 0.0, 0.0);
  const double shear = law.shear_limit(n);
  const Eigen::Vector2d t = slip_direction(y, y_t);
  return {n, -shear * t[0], -shear * t[1]};
}

}  // namespace

std::optional<int> first_rigid_contact(const ContactProblem& problem) {
  for (int i = 0; i < problem.num_contacts(); ++i)
    if (is_rigid(contact_law(problem, i))) return i;
  return std::nullopt;
}

ContactRegion contact_region(const ContactLaw& law, const Vec3& y) {
  return evaluate(without_unused_compliance(law), y).region;
}

ContactResponse contact_response(const ContactLaw& given, const Vec3& y, const Vec3& dy) {
  const ContactLaw law = without_unused_compliance(given);
  const Evaluation evaluation = evaluate(law, y);
  const auto [region, n, y_t] = evaluation;
  ContactResponse response{impulse_of(evaluation, law, y), 0.0};
  if (region == ContactRegion::separation) return response;
  if (region == ContactRegion::stick || region == ContactRegion::yield) {
    if (region == ContactRegion::stick) response.curvature += dy[0] * dy[0] / law.e_n;
    if (law.carries_shear()) response.curvature += dy.tail<2>().squaredNorm() / law.e_t;
    return response;
  }
  const Eigen::Vector2d t = slip_direction(y, y_t);
  const double along = t.dot(dy.tail<2>()), across = t[0] * dy[2] - t[1] * dy[1];
  const double theta_mu = law.dilatancy * law.mu;
  if (region == ContactRegion::slip)
    response.curvature +=
        (dy[0] - law.mu * along) * (dy[0] - theta_mu * along) / (law.e_n + theta_mu * law.mu * law.e_t);
  if (y_t > 0.0) response.curvature += law.shear_limit(n) / y_t * across * across;
  return response;
}

Vec3 contact_impulse(const ContactLaw& given, const Vec3& y) {
  const ContactLaw law = without_unused_compliance(given);
  return impulse_of(evaluate(law, y), law, y);
}

Mat3 contact_stiffness(const ContactLaw& given, const Vec3& y) {
  const ContactLaw law = without_unused_compliance(given);
  Mat3 G = Mat3::Zero();
  const auto [region, n, y_t] = evaluate(law, y);
  if (region == ContactRegion::separation) return G;
  if (region == ContactRegion::stick || region == ContactRegion::yield) {
    if (region == ContactRegion::stick) G(0, 0) = 1.0 / law.e_n;
    if (law.carries_shear()) G(1, 1) = G(2, 2) = 1.0 / law.e_t;
    return G;
  }
  const Eigen::Vector2d t = slip_direction(y, y_t);
  if (region == ContactRegion::slip) {
    const Vec3 ray(1.0, -law.mu * t[0], -law.mu * t[1]);  // gamma = n ray + const
    const double theta_mu = law.dilatancy * law.mu;
    const Vec3 opening(1.0, -theta_mu * t[0], -theta_mu * t[1]);  // n is proportional to -opening . y
    G.noalias() = ray * opening.transpose() / (law.e_n + theta_mu * law.mu * law.e_t);
  }
  if (y_t > 0.0) {  // derivative of the direction of slip
    const Eigen::Vector2d s(-t[1], t[0]);
    const Eigen::Matrix2d across = s * s.transpose();
    G.bottomRightCorner<2, 2>() += (law.shear_limit(n) / y_t) * across;
  }
  return G;
}

Mat3 sticking_stiffness(const ContactLaw& law) {
  const double tangential = law.carries_shear() ? 1.0 / law.e_t : 0.0;
  return Vec3(1.0 / law.e_n, tangential, tangential).asDiagonal();
}

Vec3 project_on_admissible(const ContactLaw& metric, const Vec3& x) {
  return contact_impulse(metric, Vec3(-metric.e_n * x[0], -metric.e_t * x[1], -metric.e_t * x[2]));
}

double limit_excess(const ContactLaw& law, const Vec3& gamma) {
  return std::max({0.0, gamma.tail<2>().norm() - law.shear_limit(gamma[0]), -law.strength.tension - gamma[0],
                   gamma[0] - law.strength.compression});
}

}  // namespace cupola
