#pragma once

#include "solver/contact/problem/second_order_cone.hpp"

namespace cupola {

/// A contact in coordinates in which Y and Y* are the same cone K: gamma^ = (mu gamma_n, gamma_t),
/// z^ = (z_n / mu, z_t). At mu = 0 only the first component is used, without scaling. For interior-point
/// methods.
struct ConicContact {
  ConicContact() = default;
  /// E: diagonal of the compliance (1/kg); 0 in problems without compliance.
  ConicContact(double mu, const Vec3& E);

  bool frictionless = false;
  Vec3 to_cone = Vec3::Ones();  ///< diagonal S: gamma^ = S gamma, z^ = S^-1 z
  Vec3 E = Vec3::Zero();
  Vec3 gamma = Vec3::UnitX();  ///< gamma^, interior of K
  Vec3 z = Vec3::UnitX();      ///< z^, interior of K
  NesterovTodd nt;             ///< of (z^, gamma^)
  Mat3 G = Mat3::Zero();       ///< (S W^2 S + E)^-1

  /// Updates `nt` and G.
  void scale();
  /// Scaled right-hand side lambda \ (target e - lambda o lambda - (W^-1 dz) o (W dgamma)) for the given
  /// affine step (dgamma, dz).
  Vec3 d(double target, const Vec3& affine_gamma, const Vec3& affine_z) const;
  /// Longest step, at most `limit`, that stays in the cones.
  double largest_step(const Vec3& d_gamma, const Vec3& d_z, double limit) const;
  /// S W^2 S, the inverse of G where E is zero.
  Mat3 compliance() const;
  /// The force gamma = S^-1 gamma^.
  Vec3 force() const;
};

}  // namespace cupola
