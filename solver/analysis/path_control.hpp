#pragma once

#include "solver/analysis/statics/length_control.hpp"

namespace cupola {

/// The control of a path, without displacement and time step. A case that names none gets the support that
/// moves farthest from its place at time 0, along that displacement, or else the free block whose load changes
/// most, along that change. Of equal ones the first is taken. Throws InputError for blocks that do not exist,
/// and where nothing changes with time and no block is named.
LengthControl path_control(const LoadPath& options, const Model& model);

}  // namespace cupola
