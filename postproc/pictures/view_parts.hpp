#pragma once

#include "postproc/pictures/views.hpp"

namespace cupola {

// What the standard views are made of.

// The colours of the 3-D view of the report.
inline constexpr Colour kFlat{0.87, 0.80, 0.70}, kCorner{0.77, 0.63, 0.45}, kUpright{0.84, 0.42, 0.16};
inline constexpr Colour kSupport{0.50, 0.53, 0.55}, kImported{0.74, 0.78, 0.70}, kThrust{0.84, 0.06, 0.24};

Colour bond_colour(const Block& block);

/// Towards the model, from the left and above. Walls and arches stand along x.
Vec3 view_direction(const Evaluation& evaluation);

/// Several surfaces as one, with a colour per face.
struct Coloured {
  BlockSurface surface;
  std::vector<Colour> colours;

  void add(const BlockSurface& more, const Colour& colour);
  void paint(Painter* painter, double opacity = 1.0) const;
};

// Views of a shell with wythes; false for others.

/// The outer wythes are taken away over a sector, and all of them over a part of it.
bool draw_cut_open(const Pictured& run, Painter* painter);
/// The wythes and the bonders apart from each other: those of a vault one above the other.
bool draw_exploded(const Pictured& run, Painter* painter);

}  // namespace cupola
