#include "solver/conic/exact_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assembly/base/error.hpp"
#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kOperationsPerContact = 100.0;

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
  // 1 / w, because w overflows beside a limit of next to nothing, as of open joints that bear no push.
  if (w > 0.0) S -= (1.0 / (1.0 / w + S(0, 0)) * S.col(0) * S.row(0)).eval();
  return S;
}

/// Impulses moved inside the limits; zero where a contact without tension carries nothing.
VecX inside_point(const ContactProblem& p, const VecX& given, double share) {
  VecX inside = VecX::Zero(given.size());
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
    inside.segment<3>(3 * i) = gamma;
  }
  return inside;
}

/// The S of one contact at impulses that inside_point() gives.
Mat3 inverse_hessian_of(const ContactProblem& p, int i, const VecX& inside) {
  const ContactLaw law = contact_law(p, i);
  const Vec3 gamma = inside.segment<3>(3 * i);
  return gamma.isZero(0.0) && law.tension_limit() == 0.0 ? Mat3(Mat3::Zero()) : inverse_hessian(law, gamma);
}

/// J S J^T in whitened unknowns.
BlockMatrix assemble_K(const WhitenedProblem& problem, const ContactGraph& graph, const VecX& inside) {
  const int nc = problem.given.num_contacts();
  std::vector<Mat3> S(nc);
  share_range(kOperationsPerContact * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) S[i] = inverse_hessian_of(problem.given, i, inside);
  });
  return assemble_stiffness(problem, graph, S);
}

/// False if K is zero or not positive definite.
bool factorize_K(const WhitenedProblem& problem, const ContactGraph& graph, const VecX& inside,
                 BlockCholesky* factor) {
  constexpr double kRounding = 1e-14;  // shift, of the largest diagonal entry
  BlockMatrix K = assemble_K(problem, graph, inside);
  const std::span<const int> unknowns = unknowns_of_block(graph.pattern);
  double largest = 0.0;
  for (const Mat6& block : K.diagonal)
    for (const int row : unknowns) largest = std::max(largest, block(row, row));
  for (Mat6& block : K.diagonal)
    for (const int row : unknowns) block(row, row) += kRounding * largest;
  return largest > 0.0 && factor->factorize(graph.pattern, K);
}

/// An upper bound of sqrt(r . K^-1 r) of the whitened imbalance, no tighter than kProvenDistance where that is
/// above.
double decrement(const WhitenedProblem& problem, const VecX& inside, const VecX& r,
                 const BlockCholesky& factor) {
  constexpr int kMaxIterations = 60;
  constexpr double kReduction = 1e-3;  // of the part of lambda that is left
  constexpr double kRest = 10.0;       // the rest is estimated with the factor, not bounded
  const auto times_K = [&](const VecX& w) {
    // S again for every product: stored, it would take a tenth of the memory of a large model.
    VecX change = relative_velocity(problem, w);
    const int nc = problem.given.num_contacts();
    share_sums(kOperationsPerContact * nc, nc, [&](int first, int last) {
      for (int i = first; i < last; ++i)
        change.segment<3>(3 * i) =
            (inverse_hessian_of(problem.given, i, inside) * change.segment<3>(3 * i)).eval();
    });
    return generalized_impulse(problem, change);
  };
  VecX rest = r, z = factor.solve(rest), direction = z;
  double rz = rest.dot(z), squared = 0.0;
  for (int k = 0; k < kMaxIterations && rz > 0.0; ++k) {
    const VecX product = times_K(direction);
    const double curvature = direction.dot(product);
    if (!(curvature > 0.0)) return kInfinite;
    const double alpha = rz / curvature;
    squared += alpha * rz;  // the energy of conjugate gradients: r . K^-1 r falls by alpha rz
    rest -= alpha * product;
    z = factor.solve(rest);
    const double next = rest.dot(z);
    const double bound = std::sqrt(squared) + kRest * std::sqrt(std::max(0.0, next));
    if (bound <= kProvenDistance || next <= kReduction * kReduction * squared) return bound;
    direction = z + next / rz * direction;
    rz = next;
  }
  return rz == 0.0 ? 0.0 : kInfinite;
}

}  // namespace

VecX imbalance_of(const ContactProblem& p, const VecX& load, const VecX& gamma) {
  using Extended = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const int nb = p.num_blocks(), nc = p.num_contacts();
  Extended sum = load.cast<long double>();
  share_sums(kOperationsPerContact * nc, nb, [&](int first, int last) {
    for (int i = 0; i < nc; ++i) {
      const auto add = [&](int k, const Lever& D) {
        if (first <= k && k < last)
          D.add_impulse(gamma.segment<3>(3 * i).cast<long double>(), sum.segment<6>(6 * k));
      };
      add(p.block_a[i], p.D_a[i]);
      add(p.block_b[i], p.D_b[i]);
    }
  });
  return -sum.cast<double>();
}

double equilibrium_distance(const WhitenedProblem& problem, const ContactGraph& graph, const VecX& load,
                            const VecX& gamma, BlockCholesky* factor) {
  const ContactProblem& p = problem.given;
  CUPOLA_ASSERT(load.size() == 6 * p.num_blocks() && gamma.size() == 3 * p.num_contacts());
  constexpr double kShare = 1e-6;  // of the shear of a joint that slides
  if (p.num_blocks() == 0) return 0.0;
  if (p.num_contacts() == 0 || !gamma.allFinite()) return kInfinite;
  const VecX inside = inside_point(p, gamma, kShare);
  if (!factorize_K(problem, graph, inside, factor)) return kInfinite;
  return decrement(problem, inside, problem.whiten_impulse(imbalance_of(p, load, inside)), *factor);
}

bool proves_equilibrium(const ContactProblem& problem, const VecX& load, const VecX& gamma) {
  BlockCholesky factor;
  return equilibrium_distance(whiten(problem), contact_graph(problem), load, gamma, &factor) <=
         kProvenDistance;
}

}  // namespace cupola
