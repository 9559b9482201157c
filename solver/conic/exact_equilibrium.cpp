#include "solver/conic/exact_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/base/error.hpp"
#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/whitening.hpp"

namespace cupola {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Impulses inside the limits, and the S of each contact; zero where it carries nothing.
struct InsidePoint {
  VecX gamma;
  std::vector<Mat3> S;
};

/// S of a contact that rubs: x = (mu n + c, t) lies in a Lorentz cone with the barrier -log(x_0^2 - |t|^2),
/// whose inverse Hessian is x x^T - (x_0^2 - |t|^2) / 2 diag(1, -1, -1). Limits of the normal force add w e
/// e^T to the Hessian.
Mat3 inverse_hessian(const ContactLaw& law, const Vec3& gamma) {
  const double n = gamma[0], tension = law.tension_limit();
  Mat3 S = Mat3::Zero();
  double w = std::isfinite(law.strength.compression) ? std::pow(law.strength.compression - n, -2) : 0.0;
  if (!law.carries_shear()) {
    S(0, 0) = 1.0 / (w + std::pow(n + tension, -2));
    return S;
  }
  if (law.mu == 0.0 || tension < law.strength.cohesion / law.mu) w += std::pow(n + tension, -2);
  const Eigen::Vector2d t = gamma.tail<2>();
  const double c = law.strength.cohesion, x0 = law.mu * n + c, det = x0 * x0 - t.squaredNorm();
  if (law.mu == 0.0) {  // a cylinder |t| <= c, with the barrier -log(c^2 - |t|^2)
    S(0, 0) = 1.0 / w;
    const Eigen::Matrix2d H = 2.0 / det * Eigen::Matrix2d::Identity() + 4.0 / (det * det) * t * t.transpose();
    S.bottomRightCorner<2, 2>() = H.inverse();
    return S;
  }
  const Vec3 ray(x0 / law.mu, t[0], t[1]);
  S = ray * ray.transpose();
  S(0, 0) -= 0.5 * det / (law.mu * law.mu);
  S(1, 1) += 0.5 * det;
  S(2, 2) += 0.5 * det;
  if (w > 0.0) S -= (w / (1.0 + w * S(0, 0)) * S.col(0) * S.row(0)).eval();
  return S;
}

InsidePoint inside_point(const ContactProblem& p, const VecX& given, double share) {
  InsidePoint point{VecX::Zero(given.size()), std::vector<Mat3>(p.num_contacts(), Mat3::Zero())};
  for (int i = 0; i < p.num_contacts(); ++i) {
    const ContactLaw law = contact_law(p, i);
    Vec3 gamma = given.segment<3>(3 * i);
    if (!law.carries_shear()) gamma.tail<2>().setZero();
    const double apex = law.tension_limit(), compression = law.strength.compression;
    const double shear = gamma.tail<2>().norm();
    gamma[0] = std::min(gamma[0], (1.0 - share) * compression);
    if (apex > 0.0)
      gamma[0] = std::max(gamma[0], -(1.0 - share) * apex);
    else if (law.strength.cohesion > 0.0)  // without tension zero is a limit, too
      gamma[0] = std::max(gamma[0], share * std::min(shear, compression));
    if (!(gamma[0] + apex > 0.0)) continue;
    const double limit = (1.0 - share) * law.shear_limit(gamma[0]);
    if (law.carries_shear() && !(limit > 0.0)) continue;
    if (shear > limit) gamma.tail<2>() *= limit / shear;
    point.gamma.segment<3>(3 * i) = gamma;
    point.S[i] = inverse_hessian(law, gamma);
  }
  return point;
}

/// -(load + D gamma), summed in extended precision.
VecX imbalance_of(const ContactProblem& p, const VecX& load, const VecX& gamma) {
  using Extended = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  Extended sum = load.cast<long double>();
  for (int i = 0; i < p.num_contacts(); ++i) {
    const Eigen::Matrix<long double, 3, 1> g = gamma.segment<3>(3 * i).cast<long double>();
    const auto add = [&](int k, const Mat63& D) {
      if (k != ContactProblem::kFixed) sum.segment<6>(6 * k) += D.cast<long double>() * g;
    };
    add(p.block_a[i], p.D_a[i]);
    add(p.block_b[i], p.D_b[i]);
  }
  return -sum.cast<double>();
}

/// An upper bound of sqrt(r . K^-1 r) of the whitened imbalance, no tighter than `enough` where that is
/// above.
double decrement(const ContactProblem& p, const Whitening& white, const ContactGraph& graph,
                 const std::vector<Mat3>& S, const VecX& r, double enough, BlockCholesky* factor) {
  constexpr int kMaxIterations = 60;
  constexpr double kReduction = 1e-3;  // of the part of lambda that is left
  constexpr double kRounding = 1e-14;  // shift of the factor, of the largest diagonal entry
  constexpr double kRest = 10.0;       // the rest is estimated with the factor, not bounded
  // Has the identity, which plane problems keep in the rows without unknowns.
  BlockMatrix K = assemble_whitened_hessian(p, white, graph, S);
  const std::span<const int> unknowns = unknowns_of_block(graph.pattern);
  double largest = 0.0;
  for (const Mat6& block : K.diagonal)
    for (const int row : unknowns) largest = std::max(largest, block(row, row));
  for (Mat6& block : K.diagonal)
    for (const int row : unknowns) block(row, row) += kRounding * largest - 1.0;
  if (!factor->factorize(graph.pattern, K)) return kInfinite;
  const auto times_K = [&](const VecX& w) {
    VecX change = relative_velocity(p, white.to_v(w));
    for (int i = 0; i < p.num_contacts(); ++i)
      change.segment<3>(3 * i) = (S[i] * change.segment<3>(3 * i)).eval();
    return white.whiten_impulse(generalized_impulse(p, change));
  };
  VecX rest = r, z = factor->solve(rest), direction = z;
  double rz = rest.dot(z), squared = 0.0;
  for (int k = 0; k < kMaxIterations && rz > 0.0; ++k) {
    const VecX product = times_K(direction);
    const double curvature = direction.dot(product);
    if (!(curvature > 0.0)) return kInfinite;
    const double alpha = rz / curvature;
    squared += alpha * rz;  // the energy of conjugate gradients: r . K^-1 r falls by alpha rz
    rest -= alpha * product;
    z = factor->solve(rest);
    const double next = rest.dot(z);
    const double bound = std::sqrt(squared) + kRest * std::sqrt(std::max(0.0, next));
    if (bound <= enough || next <= kReduction * kReduction * squared) return bound;
    direction = z + next / rz * direction;
    rz = next;
  }
  return rz == 0.0 ? 0.0 : kInfinite;
}

}  // namespace

double equilibrium_distance(const ContactProblem& problem, const Whitening& white, const ContactGraph& graph,
                            const VecX& load, const VecX& gamma, BlockCholesky* factor) {
  CUPOLA_ASSERT(load.size() == 6 * problem.num_blocks() && gamma.size() == 3 * problem.num_contacts());
  constexpr double kShare = 1e-6;  // of the shear of a joint that slides
  constexpr double kLarge =
      1e8;  // entries of K beside which the identity of assemble_hessian() is no more than rounding
  if (problem.num_blocks() == 0) return 0.0;
  if (problem.num_contacts() == 0 || !gamma.allFinite()) return kInfinite;
  InsidePoint point = inside_point(problem, gamma, kShare);
  double largest = 0.0;
  for (int i = 0; i < problem.num_contacts(); ++i)
    for (const auto& [block, D] :
         {std::pair{problem.block_a[i], &problem.D_a[i]}, {problem.block_b[i], &problem.D_b[i]}})
      if (block != ContactProblem::kFixed)
        largest = std::max(largest, point.S[i].trace() * (white.L_inverse[block] * *D).squaredNorm());
  if (!(largest > 0.0)) return kInfinite;
  const double scale = kLarge / largest;
  for (Mat3& S : point.S) S *= scale;
  const VecX r = white.whiten_impulse(imbalance_of(problem, load, point.gamma));
  return std::sqrt(scale) *
         decrement(problem, white, graph, point.S, r, std::sqrt(1.0 / scale) * kProvenDistance, factor);
}

bool proves_equilibrium(const ContactProblem& problem, const VecX& load, const VecX& gamma) {
  BlockCholesky factor;
  return equilibrium_distance(problem, Whitening(problem.M), contact_graph(problem), load, gamma, &factor) <=
         kProvenDistance;
}

}  // namespace cupola
