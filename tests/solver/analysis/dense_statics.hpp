#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>

#include "solver/contact/problem/contact_problem.hpp"

// An independent solver of the static problem in extended precision, for small assemblies: dense matrices,
// its own contact law, its own iteration. It shares only the matrices D, E, mu and b with the code under
// test.

namespace cupola::testing {

using Real = long double;
using RealVec = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RealMat = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using RealVec3 = Eigen::Matrix<Real, 3, 1>;
using RealMat3 = Eigen::Matrix<Real, 3, 3>;

/// Force of a contact that is compressed by -y, and its derivative. Associated friction: the projection of
/// -y / e on the cone |t| <= mu n in the metric e.
inline RealVec3 dense_contact_force(Real e_n, Real e_t, Real mu, const RealVec3& y, RealMat3* stiffness) {
  stiffness->setZero();
  const Real n = -y[0] / e_n, slip = y.tail<2>().norm(), t = slip / e_t;
  if (y[0] >= mu * slip) return RealVec3::Zero();
  if (mu > 0 && t <= mu * n) {
    stiffness->diagonal() << 1 / e_n, 1 / e_t, 1 / e_t;
    return {n, -y[1] / e_t, -y[2] / e_t};
  }
  const Real k = 1 / (e_n + mu * mu * e_t), a = k * (mu * slip - y[0]);
  Eigen::Matrix<Real, 2, 1> s = Eigen::Matrix<Real, 2, 1>::Zero();
  if (slip > 0) s = y.tail<2>() / slip;
  RealVec3 ray(1, -mu * s[0], -mu * s[1]);
  *stiffness = k * ray * ray.transpose();
  if (slip > 0 && mu > 0) {
    const Eigen::Matrix<Real, 2, 1> turn(-s[1], s[0]);
    stiffness->bottomRightCorner<2, 2>() += mu * a / slip * turn * turn.transpose();
  }
  return a * ray;
}

/// The same for a contact with strength: the projection on |t| <= c + mu n, -T <= n <= F.
inline RealVec3 dense_strong_force(Real e_n, Real e_t, Real mu, const ContactStrength& strength,
                                   const RealVec3& y, RealMat3* stiffness) {
  stiffness->setZero();
  const Real c = strength.cohesion, low = -std::min(Real(strength.tension), mu > 0 ? c / mu : INFINITY);
  const Real high = strength.compression, slip = y.tail<2>().norm(), n = -y[0] / e_n;
  const Real held = std::min(std::max(n, low), high);
  if (slip / e_t <= c + mu * held) {  // on a flat end, or inside
    stiffness->diagonal() << (held == n ? 1 / e_n : 0), 1 / e_t, 1 / e_t;
    return {held, -y[1] / e_t, -y[2] / e_t};
  }
  const Eigen::Matrix<Real, 2, 1> s = y.tail<2>() / slip, turn(-s[1], s[0]);
  const Real k = 1 / (e_n + mu * mu * e_t), side = k * (mu * (slip - e_t * c) - y[0]);
  const Real at = std::min(std::max(side, low), high);
  if (at == side) {
    const RealVec3 ray(1, -mu * s[0], -mu * s[1]);
    *stiffness = k * ray * ray.transpose();
  }
  stiffness->bottomRightCorner<2, 2>() += (c + mu * at) / slip * turn * turn.transpose();
  return {at, -(c + mu * at) * s[0], -(c + mu * at) * s[1]};
}

/// Impulses that solve D gamma + impulse = 0 with the contact law of `p`, to about 1e-15. Newton's method on
/// the energy with a proximal term that shrinks. Throws if it does not converge.
inline VecX dense_static_impulses(const ContactProblem& p, const VecX& impulse) {
  const Eigen::Index n = 6 * p.num_blocks(), m = 3 * p.num_contacts();
  RealMat D = RealMat::Zero(n, m), H(n, n);
  for (int i = 0; i < p.num_contacts(); ++i) {
    if (p.block_a[i] >= 0) D.block(6 * p.block_a[i], 3 * i, 6, 3) = p.D_a[i].matrix<Real>();
    if (p.block_b[i] >= 0) D.block(6 * p.block_b[i], 3 * i, 6, 3) = p.D_b[i].matrix<Real>();
  }
  const RealVec b = p.b.cast<Real>(), w = impulse.cast<Real>();
  RealVec M(n);  // metric of the proximal term
  for (int k = 0; k < p.num_blocks(); ++k) M.segment<6>(6 * k) = p.M[k].diagonal().cast<Real>();
  RealVec v = RealVec::Zero(n), centre = v, gamma = RealVec::Zero(m);
  // Sums over the two blocks of each contact; all other blocks of D are zero.
  const auto for_each_side = [&](int i, const auto& use) {
    for (const int block : {p.block_a[i], p.block_b[i]})
      if (block >= 0) use(6 * block);
  };
  const auto gradient = [&](const RealVec& at, Real weight, RealVec* forces, bool with_stiffness) {
    RealVec sum = weight * M.cwiseProduct(at - centre) - w;
    if (with_stiffness) H = RealVec(weight * M).asDiagonal();
    for (int i = 0; i < p.num_contacts(); ++i) {
      RealVec3 y = b.segment<3>(3 * i);
      for_each_side(i, [&](int k) { y += D.block<6, 3>(k, 3 * i).transpose() * at.segment<6>(k); });
      RealMat3 g;
      const RealVec3 f = p.strength.empty()
                             ? dense_contact_force(p.E[3 * i], p.E[3 * i + 1], p.mu[i], y, &g)
                             : dense_strong_force(p.E[3 * i], p.E[3 * i + 1], p.mu[i], p.strength[i], y, &g);
      forces->segment<3>(3 * i) = f;
      for_each_side(i, [&](int k) { sum.segment<6>(k) -= D.block<6, 3>(k, 3 * i) * f; });
      if (!with_stiffness) continue;
      for_each_side(i, [&](int k) {
        for_each_side(i, [&](int l) {
          H.block<6, 6>(k, l) += D.block<6, 3>(k, 3 * i) * g * D.block<6, 3>(l, 3 * i).transpose();
        });
      });
    }
    return sum;
  };
  Real weight = 1;
  for (int outer = 0; outer < 60; ++outer) {
    for (int k = 0; k < 200; ++k) {
      const RealVec g = gradient(v, weight, &gamma, true);
      if (g.norm() <= 1e-18L * w.norm()) break;
      const RealVec step = H.ldlt().solve(-g);
      // The energy is convex: bisect on the sign of its slope along the step.
      Real low = 0, high = 1;
      RealVec scratch(m);
      if (gradient(v + step, weight, &scratch, false).dot(step) > 0) {
        for (int s = 0; s < 60; ++s) {
          const Real t = (low + high) / 2;
          (gradient(v + t * step, weight, &scratch, false).dot(step) > 0 ? high : low) = t;
        }
      }
      const RealVec next = v + high * step;
      if (next == v) break;
      v = next;
    }
    gradient(v, weight, &gamma, false);
    if ((D * gamma + w).norm() <= 1e-16L * w.norm()) return gamma.cast<double>();
    centre = v;
    weight = std::max(weight / 10, Real(1e-9));
  }
  throw std::runtime_error("the dense solver did not converge");
}

}  // namespace cupola::testing
