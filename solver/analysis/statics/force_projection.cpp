#include "solver/analysis/statics/force_projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/analysis/statics/sway_stiffness.hpp"
#include "solver/conic/exact_equilibrium.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/duality_gap.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

constexpr double kOperationsPerContact = 100.0;
constexpr double kOnBoundary = 1e-9;  // distance from the cone's boundary, relative, that counts as sliding

/// True if the contact carries a normal force, or shear by cohesion.
bool is_loaded(const ContactLaw& law, const Vec3& gamma) {
  return gamma[0] > 0.0 || law.strength.cohesion > 0.0 || law.strength.tension > 0.0;
}

bool is_sliding(const ContactLaw& law, const Vec3& gamma) {
  return is_loaded(law, gamma) && gamma.tail<2>().norm() >= law.shear_limit(gamma[0]) * (1.0 - kOnBoundary);
}

/// True if the normal impulse is at the limit of tension or compression.
bool is_yielding(const ContactLaw& law, const Vec3& gamma) {
  const double tension = law.tension_limit(), compression = law.strength.compression;
  return gamma[0] >= compression * (1.0 - kOnBoundary) ||
         gamma[0] <= -tension + kOnBoundary * (tension + law.strength.cohesion);
}

double energy_norm(const ContactProblem& p, const VecX& gamma) {
  double squared = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    squared += p.E[3 * i] * gamma[3 * i] * gamma[3 * i];
    if (contact_law(p, i).carries_shear())
      squared += p.E[3 * i + 1] * gamma.segment<2>(3 * i + 1).squaredNorm();
  }
  return std::sqrt(squared);
}

/// The admissible impulse that has the tangential part of gamma, or 0 for gamma_n <= 0 in a dry joint. Shear
/// beyond what the compressive strength permits is cut.
Vec3 made_admissible(const ContactLaw& law, const Vec3& gamma) {
  if (!is_loaded(law, gamma)) return Vec3::Zero();
  double n = std::clamp(gamma[0], -law.tension_limit(), law.strength.compression);
  if (!law.carries_shear()) return {n, 0.0, 0.0};
  const double shear = gamma.tail<2>().norm();
  if (law.mu > 0.0)
    n = std::min(std::max(n, (shear - law.strength.cohesion) / law.mu), law.strength.compression);
  const bool cannot_rise = law.mu == 0.0 || n == law.strength.compression;
  const double cut = cannot_rise && shear > 0.0 ? std::min(1.0, law.shear_limit(n) / shear) : 1.0;
  return {n, cut * gamma[1], cut * gamma[2]};
}

/// Rounding of y = D^T v + b in the norm of E^-1 over the loaded contacts.
double rounding_of_velocities(const ContactProblem& p, const ContactSolution& x) {
  constexpr double kEps = 4.0 * std::numeric_limits<double>::epsilon();  // of a sum of several products
  double squared = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    if (x.gamma.segment<3>(3 * i).isZero(0.0)) continue;
    Vec3 size = p.b.segment<3>(3 * i).cwiseAbs();
    const auto add = [&](int k, const Lever& D) {
      if (k != ContactProblem::kFixed) size += D.size_of_velocity(x.v.segment<6>(6 * k));
    };
    add(p.block_a[i], p.D_a[i]);
    add(p.block_b[i], p.D_b[i]);
    squared += size[0] * size[0] / p.E[3 * i];
    if (contact_law(p, i).carries_shear()) squared += size.tail<2>().squaredNorm() / p.E[3 * i + 1];
  }
  return kEps * std::sqrt(squared);
}

}  // namespace

ForceProjection::ForceProjection(const ContactProblem& problem, VecX impulse)
    : p_(problem), impulse_(std::move(impulse)), white_(whiten(problem)), graph_(contact_graph(problem)) {}

bool ForceProjection::slides(const ContactSolution& x) const {
  for (int i = 0; i < p_.num_contacts(); ++i)
    if (is_sliding(contact_law(p_, i), x.gamma.segment<3>(3 * i))) return true;
  return false;
}

std::vector<Mat3> ForceProjection::stiffnesses(const ContactSolution& x) const {
  const VecX y = relative_velocity(p_, x.v) + p_.b;
  const int nc = p_.num_contacts();
  std::vector<Mat3> G(nc);
  share_range(kOperationsPerContact * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) G[i] = contact_stiffness(contact_law(p_, i), y.segment<3>(3 * i));
  });
  return G;
}

bool ForceProjection::is_stable(const ContactSolution& x, double gravity) {
  constexpr double kSlowest = 1e-3;  // 1/m, times gravity: squared growth rate that is not reported
  const std::vector<Mat3> G = stiffnesses(x);
  const SwayStiffness stiffness(white_, graph_, x.gamma, kSlowest * gravity * p_.h * p_.h);
  return preconditioner_.factorize(graph_.pattern, stiffness.matrix(G)) || stiffness.joints_end_sway(G);
}

/// The stiffness of the changes that the impulse of a contact may undergo: all where it sticks, in the
/// tangent plane of the admissible impulses where it slides or yields, none where it is open.
Mat3 ForceProjection::tangent(const ContactSolution& x, int i) const {
  const ContactLaw law = contact_law(p_, i);
  const Vec3 g = x.gamma.segment<3>(3 * i);
  Mat3 S = Mat3::Zero();
  if (!is_loaded(law, g)) return S;
  const bool yields = is_yielding(law, g);
  if (!law.carries_shear()) {
    if (!yields) S(0, 0) = 1.0 / law.e_n;
  } else if (is_sliding(law, g)) {
    const Eigen::Vector2d t = g.tail<2>().normalized();
    const Vec3 ray(1.0, law.mu * t[0], law.mu * t[1]), turn(0.0, -t[1], t[0]);
    const double slip = (relative_velocity(p_, i, x.v) + p_.b.segment<3>(3 * i)).tail<2>().norm();
    const double limit = law.shear_limit(g[0]);
    if (limit > 0.0) S = limit / std::max(slip, law.e_t * limit) * turn * turn.transpose();
    if (!yields) S += ray * ray.transpose() / (law.e_n + law.mu * law.mu * law.e_t);
  } else {
    S.diagonal() << (yields ? 0.0 : 1.0 / law.e_n), 1.0 / law.e_t, 1.0 / law.e_t;
  }
  return S;
}

std::vector<Mat3> ForceProjection::tangents(const ContactSolution& x) const {
  const int nc = p_.num_contacts();
  std::vector<Mat3> S(nc);
  share_range(kOperationsPerContact * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) S[i] = tangent(x, i);
  });
  return S;
}

/// The change S J^T w of the impulses that balances `imbalance`, and the velocities -L^-T w that cause it, by
/// conjugate gradients on J S J^T. None if they do not converge: the loaded contacts cannot carry it.
std::optional<ContactSolution> ForceProjection::correction(const std::vector<Mat3>& S, const VecX& imbalance,
                                                           double reduction) {
  constexpr int kMaxIterations = 200;
  const auto change = [&](const VecX& w) {
    VecX gamma = relative_velocity(white_, w);
    for (int i = 0; i < p_.num_contacts(); ++i)
      gamma.segment<3>(3 * i) = (S[i] * gamma.segment<3>(3 * i)).eval();
    return gamma;
  };
  VecX r = white_.whiten_impulse(imbalance);
  VecX gamma = VecX::Zero(p_.b.size()), w = VecX::Zero(r.size());
  const double first = r.norm();
  if (first == 0.0) return ContactSolution{w, gamma};
  VecX z = preconditioner_.solve(r), direction = z;
  double rz = r.dot(z);
  for (int k = 0; k < kMaxIterations; ++k) {
    const VecX dg = change(direction);
    const VecX product = generalized_impulse(white_, dg);
    const double curvature = direction.dot(product);
    if (!(curvature > 0.0)) return std::nullopt;
    const double alpha = rz / curvature;
    gamma += alpha * dg;
    w += alpha * direction;
    r -= alpha * product;
    if (r.norm() <= reduction * first) return ContactSolution{-white_.to_v(w), gamma};
    z = preconditioner_.solve(r);
    const double next = r.dot(z);
    direction = z + next / rz * direction;
    rz = next;
  }
  return std::nullopt;
}

bool ForceProjection::proves_equilibrium(const ContactSolution& x) {
  return equilibrium_distance(white_, graph_, impulse_, x.gamma, &preconditioner_) <= kProvenDistance;
}

std::optional<ForceErrorBound> ForceProjection::force_error(const ContactSolution& x) {
  constexpr int kRounds = 4;
  constexpr double kNegligible = 1e-2;            // of the total correction
  constexpr double kFirst = 1e-6, kLater = 1e-2;  // reductions of the imbalance in one round
  ContactSolution balanced = x;
  const auto make_admissible = [&] {
    for (int i = 0; i < p_.num_contacts(); ++i)
      balanced.gamma.segment<3>(3 * i) =
          made_admissible(contact_law(p_, i), balanced.gamma.segment<3>(3 * i));
  };
  make_admissible();
  if (!preconditioner_.has_factor() &&
      !preconditioner_.factorize(graph_.pattern, assemble_hessian(white_, graph_, tangents(balanced))))
    return std::nullopt;
  double remaining = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const std::optional<ContactSolution> change = correction(
        tangents(balanced), imbalance_of(p_, impulse_, balanced.gamma), round == 0 ? kFirst : kLater);
    if (!change) return std::nullopt;
    remaining = energy_norm(p_, change->gamma);
    const bool settled = round > 0 && remaining <= kNegligible * energy_norm(p_, balanced.gamma - x.gamma);
    if (settled || round + 1 == kRounds) break;  // the last change only measures what remains
    balanced.gamma += change->gamma;
    balanced.v += change->v;
    make_admissible();
  }
  const VecX y = relative_velocity(p_, balanced.v) + p_.b;
  double gap = 0.0;
  for (int i = 0; i < p_.num_contacts(); ++i)
    gap += contact_duality_gap(contact_law(p_, i), y.segment<3>(3 * i), balanced.gamma.segment<3>(3 * i));
  return ForceErrorBound{balanced.gamma - x.gamma,
                         remaining + std::sqrt(2.0 * gap) + rounding_of_velocities(p_, balanced)};
}

}  // namespace cupola
