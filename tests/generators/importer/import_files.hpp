#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "assembly/base/error.hpp"
#include "generators/generate.hpp"

namespace cupola::import_test {

/// Gives each test its own folder for files.
class Import : public testing::Test {
 protected:
  Import() : folder_(std::filesystem::temp_directory_path() / ("cupola_import_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Import() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  /// Message of the error with which the generator rejects a file, or "".
  static std::string complaint(const std::string& path) {
    Case c;
    c.geometry.imported.emplace();
    c.geometry.imported->path = path;
    try {
      generate(c);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  std::filesystem::path folder_;
};

inline std::string obj_box(const std::string& name, double x, double z, int first) {
  std::string text = "o " + name + "\n";
  for (double dz : {0.0, 1.0})
    for (auto [dx, dy] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
      text += fmt::format("v {:f} {} {:f}\n", x + dx, dy, z + dz);
  const int faces[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  for (const auto& face : faces) {
    text +=
        fmt::format("f {} {} {} {}\n", first + face[0], first + face[1], first + face[2], first + face[3]);
  }
  return text;
}

inline constexpr const char* kOffBox =
    "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

}  // namespace cupola::import_test
