#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "assembly/files/hash.hpp"

namespace cupola {

/// Exit code and output of a program.
struct ProgramRun {
  int code = -1;
  std::string out, err;
};

inline std::string slurp(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A temporary folder for one test, in which the built programs run.
class ProgramFolder {
 public:
  ProgramFolder() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            (std::string("cupola_programs_") + info->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(path_ / "work");
  }
  ~ProgramFolder() { std::filesystem::remove_all(path_); }
  ProgramFolder(const ProgramFolder&) = delete;
  ProgramFolder& operator=(const ProgramFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / "work" / name).string(); }

  /// Runs e.g. "cupola-solve case.yaml --output results" in the folder.
  ProgramRun run(const std::string& command) const {
    const std::string out = (path_ / "out").string(), err = (path_ / "err").string();
    const int status = std::system(("cd " + (path_ / "work").string() + " && PATH=" CUPOLA_BIN_DIR ":$PATH " +
                                    command + " >" + out + " 2>" + err)
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(err)};
  }

  /// Each file of the folder with a hash of its bytes, without `.lock`, which names the process.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_ / "work"))
      if (entry.is_regular_file() && entry.path().filename() != ".lock")
        files[entry.path().lexically_relative(path_).string()] = hash_file(entry.path());
    return files;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace cupola
