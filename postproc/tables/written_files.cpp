#include "postproc/tables/written_files.hpp"

#include <sstream>

#include "assembly/files/atomic_file.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

constexpr const char* kList = ".written";

/// By their path below the folder. Hidden ones, such as the lock, belong to no run.
std::map<std::string, fs::file_time_type> files_in(const std::string& folder) {
  std::map<std::string, fs::file_time_type> files;
  std::error_code ignored;
  for (const char* subfolder : {"", "figures", "pictures"})
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / subfolder, ignored)) {
      const std::string name = entry.path().filename().string();
      if (entry.is_regular_file(ignored) && !name.starts_with('.'))
        files[(fs::path(subfolder) / name).string()] = entry.last_write_time(ignored);
    }
  return files;
}

}  // namespace

WrittenFiles::WrittenFiles(std::string folder) : folder_(std::move(folder)), others_(files_in(folder_)) {
  const std::string list = in_folder(folder_, kList);
  if (!fs::exists(list)) return;
  std::istringstream lines(read_text(list));
  for (std::string name; std::getline(lines, name);)
    if (others_.erase(name) > 0) fs::remove(fs::path(folder_) / name);
}

WrittenFiles::~WrittenFiles() {
  std::string list;
  for (const auto& [name, time] : files_in(folder_)) {
    const auto before = others_.find(name);
    if (before == others_.end() || before->second != time) list += name + "\n";
  }
  try {
    write_text_atomically(in_folder(folder_, kList), list);
  } catch (const std::exception&) {
    // The folder cannot be written: what failed before says so, and the next run removes less.
  }
}

}  // namespace cupola
