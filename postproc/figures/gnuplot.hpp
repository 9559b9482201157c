#pragma once

#include <string>
#include <vector>

namespace cupola {

/// A figure as gnuplot commands, without terminal and output. The script contains its data as named blocks,
/// so the .gp file alone can draw the figure again.
struct Figure {
  std::string name;               ///< name of its files without ending
  std::string title;              ///< a phrase: what it shows
  std::string caption;            ///< a sentence or two: how to read it
  std::string commands;           ///< gnuplot
  int width = 900, height = 600;  ///< px
  bool vector = true;             ///< false: PNG only, for maps of thousands of blocks
};

/// The file that pages show of a figure drawn into a folder.
std::string picture_file(const std::string& folder, const Figure& figure);

/// Writes NAME.gp and NAME.svg with NAME.pdf, or NAME.png unless `vector`, into a folder. Returns one line
/// for each figure that could not be drawn; a gnuplot that is missing, fails or is killed is no error, since
/// the numbers do not depend on it.
std::vector<std::string> draw_figures(const std::string& folder, const std::vector<Figure>& figures);

/// A named data block of gnuplot, `$NAME << EOD`, with one row per line.
std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows);

/// Where a panel of a figure lies, in fractions of its width and height.
struct PanelBox {
  double left, right, bottom, top;
};

/// Boxes of equal size inside a frame, row by row from the top, with gaps between columns and rows.
std::vector<PanelBox> panel_grid(size_t rows, size_t columns, const PanelBox& frame, double column_gap,
                                 double row_gap);

/// Draws one panel in each box. Each text ends with a plot; its settings hold for the panels after it.
std::string panels(const std::vector<PanelBox>& boxes, const std::vector<std::string>& commands);

/// Escapes text for a gnuplot string in single quotes, for use without enhanced text.
std::string gnuplot_text(const std::string& text);

}  // namespace cupola
