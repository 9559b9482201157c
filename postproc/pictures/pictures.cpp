#include "postproc/pictures/pictures.hpp"

#include <cstdlib>
#include <exception>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "assembly/files/atomic_file.hpp"
#include "postproc/pictures/paraview_text.hpp"
#include "postproc/pictures/private_display.hpp"
#include "postproc/pictures/views.hpp"

namespace cupola {
namespace {

/// In a process of its own, because VTK ends the process if OpenGL is missing. Its messages go to `log`.
[[noreturn]] void draw_and_exit(const Pictured& run, const std::string& display, const std::string& folder,
                                const std::string& log) {
  int code = EXIT_SUCCESS;
  try {
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(file, 1);
    ::dup2(file, 2);
    ::setenv("DISPLAY", display.c_str(), 1);
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    for (const StandardView& view : standard_views()) {
      Painter painter(view.per_moment && run.motion.size() > 1 ? 2 * view.width : view.width, view.height);
      if (view.draw(run, &painter)) painter.save(fmt::format("{}/{}.png", folder, view.name));
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    code = EXIT_FAILURE;
  }
  std::fflush(nullptr);
  ::_exit(code);
}

}  // namespace

std::string draw_pictures(const Evaluation& e, const std::vector<Frame>& motion, const std::string& folder) {
  make_folder(folder);
  const std::string log = folder + "/pictures.log";
  std::filesystem::remove(log);
  for (const StandardView& view : standard_views())  // of an earlier run
    std::filesystem::remove(fmt::format("{}/{}.png", folder, view.name));
  const PrivateDisplay display;
  if (display.name().empty()) return "the pictures were not drawn: " + display.problem();
  const Pictured run{e, block_surfaces({e.assembly, {}, {}}), motion};
  std::fflush(nullptr);
  const pid_t painter = ::fork();
  if (painter < 0) return "the pictures were not drawn: no process could be started";
  if (painter == 0) draw_and_exit(run, display.name(), folder, log);
  int status = 0;
  ::waitpid(painter, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS) {
    std::filesystem::remove(log);
    return "";
  }
  return fmt::format("the pictures are incomplete: see {} (Debian's libgl1-mesa-dri draws without a screen)",
                     log);
}

void write_paraview_script(const std::string& folder) {
  write_text_atomically((std::filesystem::path(folder) / "open_in_paraview.py").string(), kOpenScript);
}

}  // namespace cupola
