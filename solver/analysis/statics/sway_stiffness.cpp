#include "solver/analysis/statics/sway_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "assembly/base/error.hpp"
#include "solver/contact/problem/cone.hpp"

namespace cupola {
namespace {

/// Geometric stiffness of one side of a contact times h^2, for rotations about the centroid: the force f on
/// the block acts on a point r that rotates with it.
Mat3 geometric_stiffness(const Lever& D, const Vec3& gamma, double h) {
  const Vec3& r = D.arm;
  const Vec3 f = h * (D.frame * gamma);
  return f.dot(r) * Mat3::Identity() - 0.5 * (f * r.transpose() + r * f.transpose());
}

/// Some vector that is symmetric in nothing.
VecX random_direction(Eigen::Index size) {
  std::mt19937 random(1);
  VecX direction(size);
  for (double& component : direction) component = static_cast<double>(random()) / 0x1p32 - 0.5;
  return direction.normalized();
}

/// Gives the open contacts that the motion closes the stiffness that resists it. False if it closes none.
bool close_joints(const ContactProblem& p, const VecX& motion, std::vector<Mat3>* G) {
  constexpr double kCloses = 1e-6;  // of the largest relative velocity; below it lies rounding
  const double closes = kCloses * motion.lpNorm<Eigen::Infinity>();
  bool any = false;
  for (int i = 0; i < p.num_contacts(); ++i) {
    const ContactLaw law = contact_law(p, i);
    const Vec3 y = motion.segment<3>(3 * i);
    if (!(*G)[i].isZero(0.0) || y[0] > -closes) continue;
    (*G)[i] = contact_stiffness({law.e_n, law.e_t, law.mu, law.dilatancy}, y);
    any = true;
  }
  return any;
}

}  // namespace

SwayStiffness::SwayStiffness(const WhitenedProblem& white, const ContactGraph& graph, const VecX& impulses,
                             double slowest)
    : white_(white), graph_(graph), slowest_(slowest) {
  const ContactProblem& p = white.given;
  std::vector<Mat3> of_turns(p.num_blocks(), Mat3::Zero());
  for (int i = 0; i < p.num_contacts(); ++i) {
    const auto add = [&](int k, const Lever& D) {
      if (k != ContactProblem::kFixed) of_turns[k] += geometric_stiffness(D, impulses.segment<3>(3 * i), p.h);
    };
    add(p.block_a[i], p.D_a[i]);
    add(p.block_b[i], p.D_b[i]);
  }
  for (int k = 0; k < p.num_blocks(); ++k) {
    const auto L_inverse = white.L_inverse[k].rightCols<3>();
    geometric_.emplace_back(L_inverse * of_turns[k] * L_inverse.transpose());
  }
}

double SwayStiffness::smallest(const BlockMatrix& H) const {
  constexpr double kRounding = 1e-12;  // of the largest diagonal entry
  double largest = 0.0;
  for (const Mat6& block : H.diagonal) largest = std::max(largest, block.diagonal().maxCoeff());
  return std::max(slowest_, kRounding * largest);
}

BlockMatrix SwayStiffness::matrix(const std::vector<Mat3>& G) const {
  BlockMatrix H = assemble_hessian(white_, graph_, G);
  const double added = smallest(H) - 1.0;  // the Hessian contains I
  for (size_t k = 0; k < geometric_.size(); ++k) {
    H.diagonal[k].diagonal().array() += added;
    H.diagonal[k] += geometric_[k];
  }
  return H;
}

std::optional<VecX> SwayStiffness::negative_direction(const std::vector<Mat3>& G) const {
  constexpr double kGrowth = 4.0;      // of the added multiple of the identity, until the sum is positive
  constexpr int kMaxIterations = 100;  // stiff components fall by 3/4 or more in each
  BlockMatrix H = matrix(G);
  BlockCholesky factor;
  if (factor.factorize(graph_.pattern, H)) return std::nullopt;
  double added = 0.0;
  for (double next = smallest(H); added == 0.0 || !factor.factorize(graph_.pattern, H); next *= kGrowth) {
    CUPOLA_ASSERT(std::isfinite(next));
    for (Mat6& block : H.diagonal) block.diagonal().array() += next - added;
    added = next;
  }
  // Inverse iteration, which ends where the curvature of H without the addition is negative.
  VecX before = random_direction(6 * graph_.pattern.num_blocks()), direction = before;
  for (int k = 0; k < kMaxIterations; ++k) {
    direction = factor.solve(before);
    if (direction.dot(before) < added * direction.squaredNorm()) break;
    before = direction.normalized();
  }
  return direction.normalized();
}

bool SwayStiffness::joints_end_sway(std::vector<Mat3> G, VecX direction) const {
  constexpr int kRounds = 10;  // of sways one after the other, each with more joints closed
  for (int round = 0; round < kRounds; ++round) {
    if (!close_joints(white_.given, relative_velocity(white_, direction), &G)) return false;
    const std::optional<VecX> next = negative_direction(G);
    if (!next) return true;
    direction = next->dot(direction) < 0.0 ? VecX(-*next) : *next;
  }
  return false;
}

bool SwayStiffness::joints_end_sway(const std::vector<Mat3>& G) const {
  const std::optional<VecX> direction = negative_direction(G);
  return !direction || (joints_end_sway(G, *direction) && joints_end_sway(G, -*direction));
}

}  // namespace cupola
