#pragma once

#include "assembly/base/error.hpp"
#include "assembly/model/choices.hpp"

namespace cupola {

/// How sliding contacts open: with the plastic slip velocity z_t they separate at the velocity
///
///     z_n = dilatancy mu |z_t|,    0 <= dilatancy <= 1
///
/// Ratio 1 is the associated law, a convex problem. Ratio 0 is Coulomb's law: contacts slide without opening.
/// Real joints dilate a little while their roughness is not yet worn.
struct FlowRule {
  double dilatancy = 1.0;

  FlowRule() = default;
  explicit FlowRule(double ratio) : dilatancy(ratio) {}
  /// The two ends, which have names.
  FlowRule(FrictionLaw law) : dilatancy(law == FrictionLaw::associated ? 1.0 : 0.0) {
    CUPOLA_ASSERT(law != FrictionLaw::dilatant);
  }

  bool is_associated() const { return dilatancy == 1.0; }
};

}  // namespace cupola
