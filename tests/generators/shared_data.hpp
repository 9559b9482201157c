#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace cupola {

/// Folder of block models from other projects, which are not part of the repository: the environment variable
/// CUPOLA_SHARED_DATA, else ../shared/data. Empty if it does not exist.
inline std::string shared_data() {
  const char* given = std::getenv("CUPOLA_SHARED_DATA");
  const std::filesystem::path folder = given ? given : CUPOLA_SOURCE_DIR "/../shared/data";
  return std::filesystem::is_directory(folder) ? folder.string() : "";
}

}  // namespace cupola
