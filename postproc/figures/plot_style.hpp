#pragma once

#include <string>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/evaluation/quantity_text.hpp"

namespace cupola {

/// Colours that colour-blind readers can distinguish (Okabe and Ito, 2008), in the notation of gnuplot and
/// CSS.
inline constexpr const char* kBlue = "#0072B2";
inline constexpr const char* kOrange = "#D55E00";
inline constexpr const char* kGreen = "#009E73";
inline constexpr const char* kPurple = "#CC79A7";
inline constexpr const char* kSky = "#56B4E9";
inline constexpr const char* kGrey = "#BDBDBD";  ///< what is negligible

/// Gnuplot commands that every figure starts with: borders, grid, key.
std::string plot_style();

/// Continues a plot command with the name of a curve beside one of its points: `row` of the block $data, at
/// the columns or expressions `x` and `y`. `place`: "left offset 0.6,0".
std::string curve_label(const std::string& data, size_t row, const std::string& x, const std::string& y,
                        const std::string& text, const char* colour, const char* place = "left offset 0.7,0");

/// A plot element: arrows from the columns 1 and 2 of the block $data, along the columns 3 and 4.
std::string arrows(const std::string& data, const char* colour);

/// Where a thrust line runs, with its least distance to a face and its greatest relative eccentricity.
std::string describe(const ThrustLine& line);

}  // namespace cupola
