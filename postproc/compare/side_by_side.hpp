#pragma once

#include <string>
#include <vector>

#include "postproc/figures/gnuplot.hpp"

namespace cupola {

/// The maps of the runs, wythe by wythe, on common colour scales and with the label of the run after their
/// names.
std::vector<Figure> common_maps(const std::vector<std::string>& post_folders,
                                const std::vector<std::string>& labels);

/// The picture of a figure drawn into a folder, or a sentence that it was not drawn.
std::string figure_picture(const std::string& folder, const Figure& figure, const std::string& alternative);

/// The maps, drawn in a folder, side by side under their titles.
std::string maps_html(const std::vector<Figure>& maps, const std::string& figure_folder);

}  // namespace cupola
