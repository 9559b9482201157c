#pragma once

#include "assembly/model/results.hpp"

namespace cupola {

/// Sets the role of frame `index` of a run of version 0.2, whose files do not name it.
void set_role_of_old_frame(const Summary& summary, int index, Frame* frame);

/// Frames up to version 0.4 do not name the poses at which their contacts were found: those at the end of a
/// step are taken.
void set_contact_poses_of_old_frame(Frame* frame);

}  // namespace cupola
