#pragma once

#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// Draws the standard views of a run into the folder `pictures`, as PNG: `overview`, `inside`, `forces`,
/// `thrust`, `cracks` and `motion`, those for which the run has data. `motion`: mechanisms, or instants of a
/// motion. Returns why there are none or fewer; "" if all were drawn. Requires Xvfb.
std::string draw_pictures(const Evaluation& evaluation, const std::vector<Frame>& motion,
                          const std::string& folder);

/// Writes open_in_paraview.py into the folder of a run, which opens the run in ParaView.
void write_paraview_script(const std::string& folder);

}  // namespace cupola
