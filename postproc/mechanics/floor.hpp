#pragma once

#include <cmath>

#include "postproc/mechanics/wrench.hpp"

namespace cupola {

/// The floor of a frame. Forces up to it are rounding errors or the residual of the solver. They are
/// negligible: no ratio, length or direction is formed of them.
///
///     force = max(kNegligibleShare * largest joint force, unbalanced force of a block)
struct Floor {
  double force = 0.0;  ///< N
  double share = 0.0;  ///< force over the largest joint force: floor of ratios of forces
  double length =
      0.0;  ///< m, share times the size of a block: floor of couple lengths, eccentricities and gaps

  bool hides(const Vec3& f) const { return f.norm() <= force; }
};

/// `largest`: N, largest joint force of the frame. `unbalanced`: N, force that the equilibrium leaves on a
/// block; 0 in motion. `block_size`: m.
Floor floor_of(double largest, double unbalanced, double block_size);

/// The value, or 0 if its magnitude does not exceed the floor.
inline double above(double value, double floor) {
  return std::abs(value) <= floor ? 0.0 : value;
}

/// Couple length of a wrench, m: 0 up to the floor of lengths, NaN if the force is negligible.
double couple_length(const Wrench& wrench, const Floor& floor);

}  // namespace cupola
