#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace cupola {

/// Folder of block models made by others, which the repository does not hold: the environment's
/// CUPOLA_SHARED_DATA, else shared/data beside the source. Empty when there is none.
inline std::string shared_data() {
  const char* given = std::getenv("CUPOLA_SHARED_DATA");
  const std::filesystem::path folder = given ? given : CUPOLA_SOURCE_DIR "/../shared/data";
  return std::filesystem::is_directory(folder) ? folder.string() : "";
}

}  // namespace cupola
