#pragma once

#include <string>
#include <vector>

namespace cupola {

/// A figure as gnuplot commands: everything but the terminal and the output. Its data stand in the script
/// (named blocks), so that the .gp file draws it again anywhere.
struct Figure {
  std::string name;               ///< of its files, without ending
  std::string title;              ///< what it shows, a phrase
  std::string caption;            ///< what to see in it, a sentence or two
  std::string commands;           ///< gnuplot
  int width = 900, height = 600;  ///< px
  bool vector = true;             ///< false: PNG only, for maps of very many blocks
};

/// Writes NAME.gp, NAME.svg (when `vector`) and NAME.png into a folder. Returns what went wrong, one line
/// per figure: gnuplot missing or failing costs the pictures, not the numbers.
std::vector<std::string> draw_figures(const std::string& folder, const std::vector<Figure>& figures);

/// A named data block of gnuplot: $NAME << EOD, one row per line.
std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows);

/// Text for a quoted gnuplot string with enhanced text switched off.
std::string gnuplot_text(const std::string& text);

}  // namespace cupola
