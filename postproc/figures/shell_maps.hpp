#pragma once

#include "postproc/figures/gnuplot.hpp"
#include "postproc/tables/shell_map.hpp"

namespace cupola {

inline constexpr size_t kMostVectorBoxes = 3000;  ///< with more, browsers are slow to open the SVG

/// "shell", "wall" or "wythe NAME": what the map shows, for titles.
std::string mapped_text(const ShellMap& map);

/// Ends of the colour scales of maps: the largest values of all maps included.
struct MapScales {
  double compression = 0.0, tension = 0.0;  ///< kN/m, meridional
  double hoop = 0.0;                        ///< kN/m, magnitude
  double kern = 0.0, friction = 0.0;
  void include(const ShellMap& map);
};

/// The unrolled shell, coloured by meridional and hoop force. Blocks of negligible force are grey. A quantity
/// that is negligible in all maps of the scales has no panel; without any the figure has no commands.
Figure force_map(const ShellMap& map, const MapScales& scales);

/// The same, coloured by friction and kern utilisation. Blocks without a loaded joint are grey.
Figure utilisation_map(const ShellMap& map, const MapScales& scales);

}  // namespace cupola
