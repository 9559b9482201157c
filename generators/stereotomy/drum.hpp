#pragma once

#include "generators/stereotomy/shell.hpp"

namespace cupola {

/// The wall of a drum below the springing of `shell`, with the lintels of its openings. Its members are called `drum`, or
/// `drum` and the name of a wythe or group of bonders, and `drum lintel`.
///
/// Throws InputError if an opening and its lintel reach beyond a corner of the plan or into the opening beside it.
Storey make_drum(const Drum& drum, const SurfaceMap& shell);

}  // namespace cupola
