#include "postproc/figures/plot_style.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/figures/gnuplot.hpp"

namespace cupola {

std::string plot_style() {
  // With ten digits, ticks differ at coordinates of maps, too.
  return "set border 3 lc rgb '#444444'\nset tics nomirror textcolor rgb '#222222' format '% .10g'\n"
         "set grid lc rgb '#dddddd' lw 1\nset key samplen 2 spacing 1.1\n";
}

std::string curve_label(const std::string& data, size_t row, const std::string& x, const std::string& y,
                        const std::string& text, const char* colour, const char* place) {
  return fmt::format(", ${0} every ::{1}::{1} using ({2}):({3}):('{4}') w labels {5} tc rgb '{6}' notitle",
                     data, row, x, y, gnuplot_text(text), place, colour);
}

std::string arrows(const std::string& data, const char* colour) {
  return fmt::format("${} w vectors head size screen 0.009,22,60 filled lw 1.8 lc rgb '{}'", data, colour);
}

std::string describe(const ThrustLine& line) {
  const std::string safety = std::isinf(line.least_geometric_safety)
                                 ? "it runs through the middle of every bed"
                                 : fmt::format("where half the thickness is {:.3g} times the eccentricity",
                                               line.least_geometric_safety);
  std::string text = fmt::format(
      "The thrust line {} inside the thickness. Its smallest distance from a face is {}, {}.",
      line.inside ? "stays" : "does not stay",
      length_text(line.inside ? std::max(0.0, line.least_face_distance) : line.least_face_distance), safety);
  if (line.undefined > 0)
    text +=
        fmt::format(" It is undefined at {} of {}, where the resultant is negligible or runs along the bed.",
                    line.undefined, counted(line.points.size(), "bed"));
  if (line.without_skins > 0)
    text += fmt::format(" It has no point at {}, where the blocks have no inner or outer edge.",
                        counted(line.without_skins, "bed"));
  return text;
}

}  // namespace cupola
