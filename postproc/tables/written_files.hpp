#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace cupola {

/// What a run writes into a folder and its subfolders `figures` and `pictures`. The file `.written` lists it,
/// so that the next run there removes it, and nothing else, before it writes.
class WrittenFiles {
 public:
  /// Removes the files that the run before wrote.
  explicit WrittenFiles(std::string folder);
  WrittenFiles(const WrittenFiles&) = delete;
  WrittenFiles& operator=(const WrittenFiles&) = delete;
  /// Lists the files that are new or have changed since, also after a run that failed.
  ~WrittenFiles();

 private:
  std::string folder_;
  std::map<std::string, std::filesystem::file_time_type>
      others_;  // not from the run before, by their last change
};

}  // namespace cupola
