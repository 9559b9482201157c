#pragma once

#include <numbers>
#include <string>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

inline constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Colours that colour-blind readers tell apart (Okabe and Ito), as gnuplot and CSS write them.
inline constexpr const char* kBlue = "#0072B2";
inline constexpr const char* kOrange = "#D55E00";
inline constexpr const char* kGreen = "#009E73";
inline constexpr const char* kPurple = "#CC79A7";
inline constexpr const char* kSky = "#56B4E9";

/// Gnuplot commands that every figure starts with: borders, grid, key.
std::string plot_style();

/// Unit in which forces up to `largest` (N) are read without many zeros.
struct ForceUnit {
  double per_newton = 1.0;
  const char* name = "N";
};
ForceUnit force_unit(double largest);

/// Whether the model is a vault about the z axis, so that azimuths mean something.
bool is_vault(const Evaluation& evaluation);

}  // namespace cupola
