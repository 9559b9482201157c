// Messages of the programs: counts agree with their nouns.

#include <regex>

#include <gtest/gtest.h>

#include "tests/project/repository.hpp"

namespace cupola {
namespace {

/// Counts in format strings whose noun is always in the plural: "{} blocks" prints "1 blocks". They go
/// through counted() instead. "between blocks {} and {}" is no count.
std::vector<std::string> plurals_in(const std::string& source) {
  static const std::regex seam("\"\\s*\n\\s*\"");
  static const std::regex plural(
      "\\{[^{}\"]*\\} (?:(?!of|in|to|has|joins|between)[a-z-]+ )?(?:blocks|pieces|joints|contacts|steps|"
      "iterations|solves|supports|parts|components|groups|runs|rows|values|words|stages|figures|pictures|"
      "tables|"
      "elements|ties|islands|unknowns|edges|facets|faces|points|beds|members|claims|cells)\\b(?! \\{)");
  const std::string text = std::regex_replace(source, seam, "");
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), plural); i != std::sregex_iterator(); ++i)
    found.push_back(i->str());
  return found;
}

TEST(Counts, PluralsAreFound) {
  EXPECT_EQ(plurals_in("format(\"{} \"\n  \"free blocks, {:.0f} steps\", n, m)"),
            (std::vector<std::string>{"{} free blocks", "{:.0f} steps"}));
  EXPECT_TRUE(plurals_in("format(\"{} joins blocks {} and {}; {} of {}\", a, b, c)").empty());
}

TEST(Counts, AgreeWithTheirNouns) {
  const std::vector<std::filesystem::path> files = repository_files({".cpp", ".hpp"});
  for (const std::filesystem::path& file : files) {
    const std::string name = std::filesystem::relative(file, kRepository).string();
    if (name.starts_with("tests/")) continue;
    for (const std::string& plural : plurals_in(read_text(file)))
      ADD_FAILURE() << name << ": \"" << plural << "\": use counted()";
  }
}

}  // namespace
}  // namespace cupola
