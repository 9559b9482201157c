#include "solver/contact/problem/contact_problem.hpp"

#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

namespace {

constexpr double kOperationsPerContact = 70.0;  // of a product with D

[[noreturn]] void reject(const std::string& message) {
  throw std::invalid_argument("contact problem: " + message);
}

void check_sizes(const ContactProblem& p) {
  const auto check = [](std::string_view name, std::ptrdiff_t size, std::ptrdiff_t expected) {
    if (size != expected) reject(fmt::format("{} has {} entries, expected {}", name, size, expected));
  };
  const std::ptrdiff_t nb = p.num_blocks(), nc = p.num_contacts();
  check("v_star", p.v_star.size(), 6 * nb);
  check("block_b", std::ssize(p.block_b), nc);
  check("D_a", std::ssize(p.D_a), nc);
  check("D_b", std::ssize(p.D_b), nc);
  check("b", p.b.size(), 3 * nc);
  check("E", p.E.size(), 3 * nc);
  check("mu", p.mu.size(), nc);
  if (!p.strength.empty()) check("strength", std::ssize(p.strength), nc);
}

void check_block(const ContactProblem& p, int k) {
  const Mat6& M = p.M[k];
  if (!M.allFinite()) reject(fmt::format("the mass matrix of block {} is not finite", k));
  if (!M.isApprox(M.transpose(), 1e-12))
    reject(fmt::format("the mass matrix of block {} is not symmetric", k));
  if (M.llt().info() != Eigen::Success) {
    reject(fmt::format("the mass matrix of block {} is not positive definite", k));
  }
  if (!p.v_star.segment<6>(6 * k).allFinite()) reject(fmt::format("v_star of block {} is not finite", k));
}

bool is_finite(const Lever& D) {
  return D.frame.allFinite() && D.arm.allFinite();
}

void check_contact(const ContactProblem& p, int i) {
  const int a = p.block_a[i], b = p.block_b[i];
  const auto in_range = [&p](int k) { return k >= ContactProblem::kFixed && k < p.num_blocks(); };
  if (!in_range(a) || !in_range(b))
    reject(fmt::format("contact {} joins blocks {} and {}: must be in [0, {}), or -1 for fixed", i, a, b,
                       p.num_blocks()));
  if (a == b && a == ContactProblem::kFixed) reject(fmt::format("contact {} joins no free block", i));
  if (a != ContactProblem::kFixed && !is_finite(p.D_a[i]))
    reject(fmt::format("D_a of contact {} is not finite", i));
  if (b != ContactProblem::kFixed && !is_finite(p.D_b[i]))
    reject(fmt::format("D_b of contact {} is not finite", i));
  if (!p.b.segment<3>(3 * i).allFinite()) reject(fmt::format("b of contact {} is not finite", i));
  const Vec3 E = p.E.segment<3>(3 * i);
  if (!E.allFinite() || E.minCoeff() < 0.0) {
    reject(fmt::format("E of contact {} = ({}, {}, {}): must be finite and >= 0", i, E[0], E[1], E[2]));
  }
  if (E[1] != E[2])
    reject(fmt::format("E of contact {} differs between the tangents: {}, {}", i, E[1], E[2]));
  if (!std::isfinite(p.mu[i]) || p.mu[i] < 0.0) {
    reject(fmt::format("mu of contact {} = {}: must be finite and >= 0", i, p.mu[i]));
  }
  if (p.strength.empty()) return;
  const ContactStrength& s = p.strength[i];
  if (!(std::isfinite(s.tension) && s.tension >= 0.0 && std::isfinite(s.cohesion) && s.cohesion >= 0.0 &&
        s.compression > 0.0))
    reject(fmt::format(
        "strength of contact {}: tension {}, cohesion {}, compression {}: must be >= 0, >= 0, > 0", i,
        s.tension, s.cohesion, s.compression));
}

}  // namespace

void ContactProblem::validate() const {
  check_sizes(*this);
  for (int k = 0; k < num_blocks(); ++k) check_block(*this, k);
  constexpr double kOperationsPerCheck = 30.0;
  share_range(kOperationsPerCheck * num_contacts(), num_contacts(), [&](int first, int last) {
    for (int i = first; i < last; ++i) check_contact(*this, i);
  });
  if (!std::isfinite(h) || h <= 0.0) reject(fmt::format("h = {}: must be finite and > 0", h));
}

std::string ContactProblem::defect() const {
  try {
    validate();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

VecX relative_velocity(const ContactProblem& problem, const VecX& v) {
  CUPOLA_ASSERT(v.size() == 6 * problem.num_blocks());
  VecX u(3 * problem.num_contacts());
  const int nc = problem.num_contacts();
  // Own ranges, here and in the other loops over contacts of a step: each processor has its part in its cache.
  share_sums(kOperationsPerContact * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) u.segment<3>(3 * i) = relative_velocity(problem, i, v);
  });
  return u;
}

VecX generalized_impulse(const ContactProblem& problem, const VecX& gamma) {
  CUPOLA_ASSERT(gamma.size() == 3 * problem.num_contacts());
  VecX impulse = VecX::Zero(6 * problem.num_blocks());
  const int nc = problem.num_contacts(), nb = problem.num_blocks();
  share_sums(kOperationsPerContact * nc, nb, [&](int first, int last) {
    const auto add = [&](int k, const Lever& D, int i) {
      if (first <= k && k < last) D.add_impulse(gamma.segment<3>(3 * i), impulse.segment<6>(6 * k));
    };
    for (int i = 0; i < nc; ++i) {
      add(problem.block_a[i], problem.D_a[i], i);
      add(problem.block_b[i], problem.D_b[i], i);
    }
  });
  return impulse;
}

}  // namespace cupola
