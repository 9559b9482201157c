#pragma once

#include <string>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/viewer/film.hpp"

namespace cupola {

/// A run as the 3-D view reads it: blocks, joints, forces, lines, frames, and the columns of the tables of
/// blocks and joints. packed_arrays.hpp describes the bytes.
///
/// Positions are rounded by at most largest_rounding_mm(). The columns are the doubles of the
/// tables. Above the limits in scene.cpp the scene leaves out or rounds; its key `notes` then says what.
std::string scene_bytes(const Evaluation& evaluation, const Film& film);

/// Largest distance of a vertex of the scene from its place, mm: at most 0.1, and less in models smaller than
/// 6.5 m.
double largest_rounding_mm(const Evaluation& evaluation);

}  // namespace cupola
