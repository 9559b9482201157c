#pragma once

#include <string>

#include "postproc/viewer/film.hpp"

namespace cupola {

/// The 3-D view as a part of an HTML page that needs nothing else: style, a section with the id `view`, the scene and
/// three.js (both deflated, as base64), the program that draws them, and the licence of three.js. Links with the
/// attribute data-joint="NUMBER" or data-block="NUMBER" anywhere in the page select that joint or block.
std::string viewer_html(const Evaluation& evaluation, const Film& film);

}  // namespace cupola
