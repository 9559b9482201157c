#pragma once

#include "assembly/model/results.hpp"

namespace cupola {

/// Sets the role of frame `index` of a run of version 0.2, whose files do not name it.
void set_role_of_old_frame(const Summary& summary, int index, Frame* frame);

}  // namespace cupola
