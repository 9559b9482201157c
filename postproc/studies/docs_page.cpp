#include "postproc/studies/docs_page.hpp"

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "postproc/figures/process.hpp"

namespace cupola {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(": ") + 2);
  return "unknown processor";
}

}  // namespace

std::string common_revision(const std::vector<std::string>& runs, RunCache& cache) {
  std::map<std::string, std::vector<std::string>> runs_of_revision;
  for (const std::string& run : runs) runs_of_revision[cache.run(run).revision()].push_back(run);
  CUPOLA_ASSERT(!runs_of_revision.empty());
  const std::string& revision = runs_of_revision.begin()->first;
  if (runs_of_revision.size() > 1) {
    std::string list;
    for (const auto& [name, of_name] : runs_of_revision)
      list += fmt::format("{}{} ({})", list.empty() ? "" : "; ", name, fmt::join(of_name, " "));
    throw InputError("the runs come from different revisions; run them again: " + list);
  }
  if (revision.ends_with("-dirty") || revision.starts_with("unknown"))
    throw InputError(
        fmt::format("the runs come from programs of {} (revision {}); commit, build and run again: {}",
                    revision.ends_with("-dirty") ? "changed sources" : "unknown sources", revision,
                    fmt::join(runs, " ")));
  return revision;
}

std::string measured_line(const std::string& revision) {
  double load = 0.0;
  ::getloadavg(&load, 1);
  const std::time_t now = std::time(nullptr);
  std::tm today{};
  ::localtime_r(&now, &today);
  return fmt::format(
      "Measured {:%Y-%m-%d} by the programs of revision {} on {} of {},\nload average {:.1f} at the end.",
      today, revision, counted(std::thread::hardware_concurrency(), "core"), processor_name(), load);
}

void require_clean_tree(const std::string& root) {
  const std::string log = (std::filesystem::temp_directory_path() /
                           fmt::format("cupola_status_{}", static_cast<long long>(::getpid())))
                              .string();
  const int code = run_process({"git", "-C", root, "status", "--porcelain", "--untracked-files=no", "--",
                                ":/", ":(top,exclude)*.md", ":(top,exclude)docs/pictures"},
                               log);
  const std::string changed = code == 0 ? read_text(log) : "";
  std::filesystem::remove(log);
  if (code != 0)
    throw InputError(fmt::format(
        "{}: git cannot show whether files are changed, so that no table is written to a page", root));
  if (!changed.empty())
    throw InputError(fmt::format("no table is written to a page while files are changed; commit first:\n{}",
                                 changed.substr(0, changed.find_last_not_of('\n') + 1)));
}

void write_to_page(const std::string& page, const std::string& name, const std::string& text) {
  std::string all = read_text(page);
  const std::string start = fmt::format("<!-- table {} -->\n", name), end = "<!-- end -->";
  const size_t first = all.find(start);
  const size_t last = first == std::string::npos ? first : all.find(end, first);
  if (last == std::string::npos || all.find(start, first + 1) != std::string::npos)
    throw InputError(FileLocation{page},
                     fmt::format("needs one pair of the lines `<!-- table {} -->` and `<!-- end -->`", name));
  all.replace(first + start.size(), last - first - start.size(), "\n" + text + "\n\n");
  write_text_atomically(page, all);
}

}  // namespace cupola
