#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Static equilibrium of a small model under the associated law, in extended precision.
struct ExactStatics {
  bool found = false;
  /// Largest unbalanced force over the mean block weight, moments divided by the size of the block. The
  /// forces obey the contact law exactly, so they are exact for loads that differ by this much.
  double residual = 0.0;
  int iterations = 0;
  std::vector<Vec3> forces;  ///< N, world, on block b, one per contact point
};

/// Minimises the static energy over the displacements d by a damped Newton method on dense matrices. With
/// y_i = D_i^T d + g_i at contact i, its gradient is
///
///     - f - sum_i D_i gamma_i,   gamma_i = projection of -C_i^-1 y_i on the cone in the norm of C_i
///
/// C = diag(c_n, c_t, c_t), g the initial gaps. Displacements and forces have a mantissa of 113 bits: a stiff
/// joint beside soft ones turns the rounding of a large displacement into a force, which at a contrast of 1e7
/// is 1e-8 of a weight in double precision. Newton directions are in long double. There is no mass and no
/// time step: contact points, their frames and the joint laws are those of the solver, the method and the
/// matrices are not. Every contact needs a compliance > 0.
ExactStatics solve_exact_statics(const Case& scene, const Assembly& assembly);

}  // namespace cupola
