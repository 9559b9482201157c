#include "postproc/pictures/paraview_views.hpp"

#include <filesystem>
#include <sstream>

#include <fmt/format.h>

#include "assembly/files/atomic_file.hpp"
#include "postproc/figures/process.hpp"
#include "postproc/pictures/views_text.hpp"

namespace cupola {
namespace {

struct View {
  const char* name;
  const char* caption;
  bool of_forces = false;
};

// In the order of the report. views.py skips views for which a run has no data.
constexpr View kViews[] = {
    {"joints",
     "Resultant of every joint, drawn from its centre of pressure; joint_forces.vtp holds the scale.", true},
    {"thrust_lines", "Thrust lines (orange) between intrados and extrados (black).", true},
    {"sections", "Sections and the resultants across the beds nearest to them.", true},
    {"blocks_meridional", "Meridional force per metre of ring, compression positive.", true},
    {"blocks_hoop", "Hoop force per metre of meridian, compression positive.", true},
    {"blocks_friction", "Largest friction utilisation of the joints of each block. Grey: no loaded joint.",
     true},
    {"cracks", "Open joints."},
    {"motion_1", "Motion after a quarter of the frames; each colour is one body of the mechanism."},
    {"motion_2", "Motion after half of the frames."},
    {"motion_3", "Motion after three quarters of the frames."},
    {"motion_4", "Motion in the last frame."},
};

std::vector<std::string> words_of(const std::string& command) {
  std::istringstream in(command);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

}  // namespace

void write_views(const std::string& folder) {
  write_text_atomically((std::filesystem::path(folder) / "views.py").string(), kViewsScript);
  write_text_atomically((std::filesystem::path(folder) / "open_in_paraview.py").string(), kOpenScript);
}

std::vector<Picture> draw_pictures(const std::string& folder, const std::string& pvbatch, bool at_rest,
                                   std::vector<std::string>* problems) {
  const std::filesystem::path base(folder), log = base / "views.log";
  for (const View& view : kViews)  // pictures of an earlier run must not appear in this report
    std::filesystem::remove(base / "pictures" / (std::string(view.name) + ".png"));
  std::vector<std::string> words = words_of(pvbatch);
  words.push_back((base / "views.py").string());
  const int code = run_process(words, log.string());
  if (code == kNotFound)
    problems->push_back(fmt::format("the 3-D pictures are incomplete: command `{}` was not found", pvbatch));
  else if (code != 0)
    problems->push_back(fmt::format(
        "the 3-D pictures are incomplete: `{}` ended with exit code {}, see views.log", pvbatch, code));
  else
    std::filesystem::remove(log);
  std::vector<Picture> pictures;
  for (const View& view : kViews) {
    if (view.of_forces && !at_rest) continue;
    const std::string path = (base / "pictures" / (std::string(view.name) + ".png")).string();
    if (std::filesystem::exists(path)) pictures.push_back({path, view.caption});
  }
  return pictures;
}

}  // namespace cupola
