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
};

// In the order of the report; views.py leaves out what a run has nothing to show for.
constexpr View kViews[] = {
    {"joints", "Resultant of every joint, drawn from its centre of pressure to the scale in joints.vtp."},
    {"thrust_lines", "Thrust lines (orange) between intrados and extrados (black)."},
    {"sections", "Sections with the resultants that the nearest ring receives from below."},
    {"blocks_meridional", "Meridional force per metre of ring, compression positive."},
    {"blocks_hoop", "Hoop force per metre of meridian: compression and tension of the rings."},
    {"blocks_friction", "Largest friction utilisation of each block's joints."},
    {"cracks", "Open joints."},
    {"motion_1", "The motion after a quarter of the frames; colours are the bodies of the mechanism."},
    {"motion_2", "After half of the frames."},
    {"motion_3", "After three quarters of the frames."},
    {"motion_4", "The last frame."},
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
}

std::vector<Picture> draw_pictures(const std::string& folder, const std::string& pvbatch,
                                   std::vector<std::string>* problems) {
  const std::filesystem::path base(folder), log = base / "views.log";
  for (const View& view : kViews)  // pictures of an earlier run must not pass for this one's
    std::filesystem::remove(base / "pictures" / (std::string(view.name) + ".png"));
  std::vector<std::string> words = words_of(pvbatch);
  words.push_back((base / "views.py").string());
  const int code = run_process(words, log.string());
  if (code == kNotFound)
    problems->push_back(fmt::format("the 3-D pictures are not complete: there is no `{}`", pvbatch));
  else if (code != 0)
    problems->push_back(
        fmt::format("the 3-D pictures are not complete: `{}` ended with {}, see views.log", pvbatch, code));
  else
    std::filesystem::remove(log);
  std::vector<Picture> pictures;
  for (const View& view : kViews) {
    const std::string path = (base / "pictures" / (std::string(view.name) + ".png")).string();
    if (std::filesystem::exists(path)) pictures.push_back({path, view.caption});
  }
  return pictures;
}

}  // namespace cupola
