#pragma once

#include <string>
#include <vector>

namespace cupola {

/// A picture and its caption.
struct Picture {
  std::string path;  ///< of the PNG
  std::string caption;
};

/// Writes two scripts for ParaView into the folder: open_in_paraview.py opens the run in its window, views.py
/// draws the standard views in pvbatch or as a macro.
void write_views(const std::string& folder);

/// Draws the standard views into folder/pictures with the given command: pvbatch, or a command line that runs
/// it. Returns the pictures, of a run that is not `at_rest` those without forces, and appends failures to
/// `problems`.
std::vector<Picture> draw_pictures(const std::string& folder, const std::string& pvbatch, bool at_rest,
                                   std::vector<std::string>* problems);

}  // namespace cupola
