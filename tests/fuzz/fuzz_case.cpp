// Case files as text, in a folder with the project's cases, which they may extend. Promise: the effective
// YAML of an accepted case is accepted and reads back unchanged.

#include "assembly/case/case_reader.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace cupola {
namespace {

void copy_cases(const std::string& from, const std::string& to) {
  std::filesystem::create_directories(to);
  for (const auto& entry : std::filesystem::directory_iterator(std::string(CUPOLA_SOURCE_DIR) + from))
    if (entry.path().extension() == ".yaml")
      std::filesystem::copy(entry.path(), std::filesystem::path(to) / entry.path().filename());
}

}  // namespace

bool reader_accepts(std::string_view bytes) {
  static const ScratchPath folder("_cases");
  static const std::string path = [&] {
    copy_cases("/cases", folder.path);
    copy_cases("/tests/invalid_input", folder.path);
    return folder.path + "/fuzz.yaml";
  }();
  write_bytes(path, bytes);
  Case first;
  if (!accepts([&] { first = read_case(path); })) return false;
  write_bytes(path, first.effective_yaml);
  Case again;
  demand(accepts([&] { again = read_case(path); }), "the effective YAML is a valid case");
  demand(again.effective_yaml == first.effective_yaml, "the effective YAML is effective of itself");
  return true;
}

}  // namespace cupola
