#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace cupola::test {

/// An empty folder for the running test. All folders of a process are below one folder that is removed when
/// the process ends, so that test programs can run at the same time.
inline std::string fresh_folder(const std::string& name) {
  struct Root {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("cupola_tests_" + std::to_string(::getpid()));
    ~Root() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Root root;
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto folder = root.path / (std::string(test->test_suite_name()) + "." + test->name() + "." + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder.string();
}

}  // namespace cupola::test
