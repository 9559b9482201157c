#pragma once

#include "solver/dynamics/energy_account.hpp"

namespace cupola {

/// Time of impact sqrt(c / N_nn) of a contact, s: sqrt(m c) for the mass m that meets the compliance c. A
/// contact that closes in a shorter step, and whose damper is weaker (alpha below this time), is compressed
/// and bounces; in a longer step it stops.
///
/// Returns the longest time of impact of the contacts that begin to bounce in the step, or 0. Contacts that
/// meet more slowly than by `acceleration` (m/s2) in this time stay closed under loads of that size.
double elastic_impact(const StepStart& start, const StepProblem& step, const ContactSolution& solution,
                      double acceleration, const StepOptions& options);

}  // namespace cupola
