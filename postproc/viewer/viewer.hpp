#pragma once

#include <string>
#include <vector>

#include "postproc/viewer/film.hpp"

namespace cupola {

/// The 3-D view as a part of an HTML page that needs nothing else: style, a section with the id `view`, the
/// scene and three.js (both deflated, as base64), the program that draws them, and the licence of three.js.
/// Links with the attribute data-joint="NUMBER" or data-block="NUMBER" anywhere in the page select that joint
/// or block.
std::string viewer_html(const Evaluation& evaluation, const Film& film);

/// The scene in such a page, as it stands there; "" without one.
std::string scene_of_report(const std::string& html);

struct LabelledScene {
  std::string label;  ///< without characters that HTML reserves
  std::string scene;  ///< from scene_of_report()
};

/// Several scenes side by side: one camera, one set of controls, one scale of colours and forces.
std::string linked_views_html(const std::vector<LabelledScene>& scenes);

}  // namespace cupola
