#include "postproc/pictures/paraview.hpp"

#include <filesystem>

#include "assembly/files/atomic_file.hpp"
#include "postproc/pictures/paraview_text.hpp"

namespace cupola {

void write_paraview_script(const std::string& folder) {
  write_text_atomically((std::filesystem::path(folder) / "open_in_paraview.py").string(), kOpenScript);
}

}  // namespace cupola
