#pragma once

#include "assembly/case/case.hpp"
#include "solver/collision/contact_detector.hpp"

namespace cupola {

/// What the case asks of the contact detection: compliance per area needs points that integrate the patch.
DetectionOptions detection_options(const Case& scene);

}  // namespace cupola
