#pragma once

#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/pictures/painter.hpp"
#include "postproc/pictures/pictures.hpp"

namespace cupola {

/// A run and the surfaces of its blocks.
struct Pictured {
  const Evaluation& e;
  std::vector<BlockSurface> blocks;
  std::vector<Frame> motion;
};

/// A standard view: a file name, and a function that draws it, or returns false if the run has no data for
/// it.
struct StandardView {
  const char* name;
  int width, height;  ///< pixels
  bool (*draw)(const Pictured&, Painter*);
  bool per_moment = false;  ///< twice as wide if the motion has several moments
};
const std::vector<StandardView>& standard_views();

}  // namespace cupola
