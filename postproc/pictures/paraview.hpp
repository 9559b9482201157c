#pragma once

#include <string>

namespace cupola {

/// Writes open_in_paraview.py into the folder of a run, which opens the run in ParaView.
void write_paraview_script(const std::string& folder);

}  // namespace cupola
