// Only the room of surfaces, and the reader that declares their keys, may ask what kind a surface is.

#include <regex>

#include <gtest/gtest.h>

#include "tests/project/repository.hpp"

namespace cupola {
namespace {

std::vector<std::string> questions_in(const std::string& text) {
  static const std::regex question(
      "\\b(?:get|get_if|holds_alternative)<(?:DomeSurface|OctagonalVault|ArchSurface|WallSurface)>|"
      "\\btraits_of\\(|geometry\\.surface\\b");
  std::vector<std::string> found;
  for (auto i = std::sregex_iterator(text.begin(), text.end(), question); i != std::sregex_iterator(); ++i)
    found.push_back(i->str());
  return found;
}

TEST(SurfaceQuestions, AreFoundInText) {
  EXPECT_EQ(questions_in("std::get_if<OctagonalVault>(&surface)").size(), 1u);
  EXPECT_EQ(questions_in("traits_of(surface).closed").size(), 1u);
  EXPECT_EQ(questions_in("const Surface& surface = e.scene.geometry.surface;").size(), 1u);
  EXPECT_TRUE(questions_in("e.assembly.sheets.back().thrust_lines").empty());
}

TEST(SurfaceQuestions, AreAskedByTheGeneratorsOnly) {
  for (const auto& file : repository_files({".cpp", ".hpp"})) {
    const std::string folder = std::filesystem::relative(file, kRepository).string();
    if (!folder.starts_with("solver/") && !folder.starts_with("postproc/") &&
        !folder.starts_with("assembly/model/") && !folder.starts_with("assembly/files/"))
      continue;
    for (const std::string& question : questions_in(read_text(file)))
      ADD_FAILURE() << folder << ": `" << question << "`; ask the sheets of the assembly";
  }
}

}  // namespace
}  // namespace cupola
