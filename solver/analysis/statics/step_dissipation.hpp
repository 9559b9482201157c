#pragma once

#include <map>

#include "solver/analysis/statics/static_solve.hpp"

namespace cupola {

/// What joints and ties dissipate in a step of a path, which several solves may make: the later ones correct
/// where the first has led. A contact that slips back in them gets back the work of that way. A tie yields by
/// what it is elongated at the end, so that the last solve has all of its work.
class StepDissipation {
 public:
  /// A solve from `start` that found an equilibrium.
  void include(const State& start, const ContactSet& contacts, const StaticSolution& solution);
  double total() const;  ///< J

 private:
  struct Slip {
    Vec3 way_A = Vec3::Zero();  // m, axes of block a
    double work = 0.0;          // J
  };
  std::map<ContactId, Slip> slips_;
  double breaking_ = 0.0;  // J, tension and crushing
  double yielding_ = 0.0;  // J, of ties
};

}  // namespace cupola
