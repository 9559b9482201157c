#pragma once

#include "assembly/case/case.hpp"
#include "solver/collision/contact_detector.hpp"
#include "solver/contact/methods/solve_contact.hpp"

namespace cupola {

/// What the case asks of the contact detection: compliance per area needs points that integrate the patch.
DetectionOptions detection_options(const Case& scene);

/// Method and friction law of the case, and its tolerance; the reference speed is the step's to set.
ContactSolverOptions contact_solver_options(const Analysis& analysis);

}  // namespace cupola
