#pragma once

#include "assembly/model/sheet.hpp"

namespace cupola {

/// What a kind of surface is, for code that must not know the kinds: the reader and the stereotomy. Each kind
/// states its own traits and nothing else asks for a kind by name.
struct SurfaceTraits {
  bool closed = false;  ///< courses are rings about the z axis; their last block meets the first
  Sheet::ThrustLines thrust_lines = Sheet::ThrustLines::none;
};

}  // namespace cupola
