#pragma once

#include <string>
#include <vector>

namespace cupola {

/// A picture and its caption.
struct Picture {
  std::string path;  ///< of the PNG
  std::string caption;
};

/// Writes views.py into the folder. It draws the standard views of a run, in pvbatch or as a macro of
/// ParaView.
void write_views(const std::string& folder);

/// Draws the standard views into folder/pictures with the given command: pvbatch, or a command line that runs
/// it. Returns the pictures, of a run that is not `at_rest` those without forces, and appends failures to
/// `problems`.
std::vector<Picture> draw_pictures(const std::string& folder, const std::string& pvbatch, bool at_rest,
                                   std::vector<std::string>* problems);

}  // namespace cupola
