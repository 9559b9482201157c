#pragma once

#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// Name of the thrust line of a model that is one arch.
inline constexpr const char* kOnlyArch = "arch";

/// The name of a wythe or member as a part of file names: letters, digits, _ and -, and what is not ASCII.
std::string in_file_names(std::string text);

/// What the thrust lines of a frame are computed from. It refers to both arguments.
ThrustInput thrust_input(const Evaluation& evaluation, const FrameEvaluation& frame);

/// The meridians of the case for the frame evaluated, or those over the x and y axes; of an arch its only
/// one. Other models have none.
std::vector<MeridianEvaluation> evaluate_meridians(const Evaluation& evaluation);

/// Adds the thrust lines of the states of least and greatest thrust to the meridians, if the run is a range
/// analysis with frames for the bounded ends of a quantity whose name begins with "thrust"; the first such
/// quantity counts.
void add_ends_of_thrust(const ResultsReader& results, Evaluation* evaluation);

}  // namespace cupola
