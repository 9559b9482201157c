// Only the room of surfaces may ask what kind a surface is; the reader and the generators may pass it on; all
// others ask the sheets.

#include <regex>

#include <gtest/gtest.h>

#include "tests/project/repository.hpp"

namespace cupola {
namespace {

std::vector<std::string> matches_in(const std::string& text, const std::regex& question) {
  std::vector<std::string> found;
  for (auto i = std::sregex_iterator(text.begin(), text.end(), question); i != std::sregex_iterator(); ++i)
    found.push_back(i->str());
  return found;
}

std::vector<std::string> kinds_asked_in(const std::string& text) {
  static const std::regex question(
      "\\b(?:get|get_if|holds_alternative)<(?:DomeSurface|OctagonalVault|ArchSurface|WallSurface|"
      "VaultSurface)>");
  return matches_in(text, question);
}

std::vector<std::string> questions_in(const std::string& text) {
  static const std::regex question("\\btraits_of\\(|geometry\\.surface\\b");
  std::vector<std::string> found = kinds_asked_in(text);
  for (std::string& match : matches_in(text, question)) found.push_back(std::move(match));
  return found;
}

TEST(SurfaceQuestions, AreFoundInText) {
  EXPECT_EQ(questions_in("std::get_if<OctagonalVault>(&surface)").size(), 1u);
  EXPECT_EQ(kinds_asked_in("std::holds_alternative<VaultSurface>(surface)").size(), 1u);
  EXPECT_EQ(questions_in("traits_of(surface).closed").size(), 1u);
  EXPECT_TRUE(kinds_asked_in("traits_of(surface).closed").empty());
  EXPECT_EQ(questions_in("const Surface& surface = e.scene.geometry.surface;").size(), 1u);
  EXPECT_TRUE(questions_in("e.assembly.sheets.back().thrust_lines").empty());
}

TEST(SurfaceQuestions, OfTheKindAreAskedByTheRoomOfSurfacesOnly) {
  int programs = 0;
  for (const auto& file : repository_files({".cpp", ".hpp"})) {
    const std::string folder = std::filesystem::relative(file, kRepository).string();
    if (folder.starts_with("tests/") || folder.starts_with("generators/surface/")) continue;
    ++programs;
    for (const std::string& question : kinds_asked_in(read_text(file)))
      ADD_FAILURE() << folder << ": `" << question << "`; add a trait, or an argument of the drawing";
  }
  EXPECT_GT(programs, 100);
}

TEST(SurfaceQuestions, AreAskedByTheReaderAndTheGeneratorsOnly) {
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
