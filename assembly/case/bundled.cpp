#include "assembly/case/bundled.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "assembly/case/case_node.hpp"

namespace cupola {
namespace {

bool is_plain_word(const std::string& name) {
  return !name.empty() &&
         std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace

std::string bundled_folder() {
  namespace fs = std::filesystem;
  if (const char* given = std::getenv("CUPOLA_CASES")) return fs::is_directory(given) ? given : "";
  std::error_code error;
  const fs::path programs = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return {};
  for (const char* beside : {"../share/cupola/cases", "../../cases"})
    if (const fs::path folder = (programs / beside).lexically_normal(); fs::is_directory(folder, error))
      return folder.string();
  return {};
}

std::string bundled_case(const std::string& name, const FileLocation& where) {
  const std::string word = name.substr(std::string_view(kBundledPrefix).size());
  const std::string folder = bundled_folder();
  if (folder.empty())
    throw InputError(
        where, fmt::format("{}: the folder of the bundled cases is missing beside the programs; set the "
                           "environment variable CUPOLA_CASES",
                           shown(name)));
  const std::filesystem::path path = std::filesystem::path(folder) / (word + ".yaml");
  if (is_plain_word(word) && std::filesystem::is_regular_file(path)) return path.string();
  const std::string near = nearest_name(std::filesystem::path(word).stem().string(), names_in(folder));
  throw InputError(where,
                   fmt::format("{}: no bundled case has this name{}", shown(name),
                               near.empty() ? fmt::format("; they are in {}", folder)
                                            : fmt::format("; did you mean {}{}?", kBundledPrefix, near)));
}

bool is_bundled(const std::string& file) {
  const std::string folder = bundled_folder();
  return !folder.empty() && std::filesystem::path(file).parent_path() == std::filesystem::path(folder);
}

}  // namespace cupola
