#pragma once

#include <string>
#include <vector>

namespace cupola {

/// A picture with the words below it.
struct Picture {
  std::string path;  ///< of the PNG
  std::string caption;
};

/// Writes views.py into the folder: the standard views of a model, for pvbatch or as a macro of ParaView.
void write_views(const std::string& folder);

/// Draws them with the given command (pvbatch, or words that end in it) into folder/pictures. Returns the
/// pictures; what went wrong is added to `problems`.
std::vector<Picture> draw_pictures(const std::string& folder, const std::string& pvbatch,
                                   std::vector<std::string>* problems);

}  // namespace cupola
