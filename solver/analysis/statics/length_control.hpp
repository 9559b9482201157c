#pragma once

#include <functional>
#include <optional>

#include "solver/dynamics/model.hpp"

namespace cupola {

/// Control of a path of equilibria by the displacement of one block, or of one block relative to another,
/// instead of by time: the time, to which loads, supports and friction follow their functions, becomes an
/// unknown. The path then passes a largest load and follows the descending branch; a displacement across the
/// crack that opens also follows branches on which the displacement of the load falls (indirect displacement
/// control: R. de Borst 1987, "Computation of post-bifurcation and post-failure behavior of strain-softening
/// solids", Computers & Structures 25(2), 211-224). De Borst solves for the load factor by two right-hand
/// sides of one matrix; here contacts make the problem nonsmooth, and the time is a root.
struct LengthControl {
  int block = 0;
  int relative_to = -1;            ///< block; -1: the world
  Vec3 direction = Vec3::UnitX();  ///< unit
  double displacement = 0.0;       ///< m, to be reached; 0: a step is repeated in the geometry at its end
  double length = 0.0;             ///< m, > 0: displacement of the whole step, of which a share may be missed
  double earliest = 0.0, latest = 1.0;  ///< s, bounds of the time
  double time_step = 0.01;              ///< s, > 0: first change of the time tried
};

/// Displacement of the control in a step from `start` to `time`, m, in which free blocks move by `d` (6 nb).
double control_displacement(const Model& model, const State& start, const LengthControl& control, double time,
                            const VecX& d);

/// A root of an increasing function.
struct RootSearch {
  double low = 0.0, high = 1.0;  ///< bounds
  double guess = 0.0;            ///< between the bounds
  double step = 0.1;             ///< > 0: first step from the guess
  double slope = 0.0;      ///< of the function near the root, if known: determines the first step; 0: unknown
  double tolerance = 0.0;  ///< of the value of the function
};

/// The last argument at which `f` was evaluated: its value there is within the tolerance, the bracket of the
/// root as narrow as rounding admits, or the root beyond the bound. Steps that grow fourfold find a bracket;
/// bisection and inverse quadratic interpolation narrow it (T. R. Chandrupatla 1997, "A new hybrid
/// quadratic/bisection algorithm for finding the zero of a nonlinear function without using derivatives",
/// Advances in Engineering Software 28, 145-149), because `f` has kinks where joints yield. None if `f`
/// failed.
std::optional<double> find_root(const RootSearch& search,
                                const std::function<std::optional<double>(double)>& f);

}  // namespace cupola
