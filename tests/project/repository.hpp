#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace cupola {

inline const std::filesystem::path kRepository = CUPOLA_SOURCE_DIR;

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// All files of the repository with one of the endings, sorted; without hidden folders, builds and results.
inline std::vector<std::filesystem::path> repository_files(const std::set<std::string>& endings) {
  std::vector<std::filesystem::path> files;
  for (auto i = std::filesystem::recursive_directory_iterator(kRepository);
       i != std::filesystem::recursive_directory_iterator(); ++i) {
    const std::string name = i->path().filename().string();
    if (i->is_directory()) {
      const bool at_root = i.depth() == 0;
      if (name.front() == '.' || (at_root && (name.starts_with("build") || name == "out"))) {
        i.disable_recursion_pending();
      }
    } else if (endings.contains(i->path().extension().string())) {
      files.push_back(i->path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace cupola
