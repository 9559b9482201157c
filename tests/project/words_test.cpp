// Phrases that the repository's texts must not contain, because readers stumbled over them.

#include <cctype>
#include <regex>

#include <gtest/gtest.h>

#include "tests/project/repository.hpp"

namespace cupola {
namespace {

/// Lower case; line breaks together with comment markers and the seams of string literals become one space.
std::string plain_text(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (std::isspace(static_cast<unsigned char>(text[i])) == 0) {
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(text[i])));
      continue;
    }
    const std::size_t end = text.find_first_not_of(" \t\r\n", i);
    const std::size_t next = text.substr(i, end - i).find('\n') == std::string::npos
                                 ? end
                                 : text.find_first_not_of(" \t\r\n/#*\"", i);
    while (!plain.empty() && (plain.back() == '"' || plain.back() == ' ')) plain.pop_back();
    plain += ' ';
    if (next == std::string::npos) break;
    i = next - 1;
  }
  return plain;
}

std::vector<std::string> phrases_in(const std::string& text) {
  static const std::vector<std::string> unwanted = {"bond pattern does to its forces",
                                                    "own hope",
                                                    "directions by a hierarchy",
                                                    "lead nowhere",
                                                    "leads nowhere",
                                                    "supports go on in this step",
                                                    "tests of seconds",
                                                    "who wakes",
                                                    "what sleeps",
                                                    "let h leap",
                                                    "nobody vouches",
                                                    "by degrees",
                                                    "in vain",
                                                    "a trifle",
                                                    "hierarchy of groups"};
  const std::string plain = plain_text(text);
  std::vector<std::string> found;
  for (const std::string& phrase : unwanted) {
    if (plain.find(phrase) != std::string::npos) found.push_back(phrase);
  }
  return found;
}

/// Counts in format strings whose noun is always in the plural: "{} blocks" prints "1 blocks". They go through
/// counted() instead. "between blocks {} and {}" is no count.
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

TEST(Words, PluralCountsAreFound) {
  EXPECT_EQ(plurals_in("format(\"{} \"\n  \"free blocks, {:.0f} steps\", n, m)"),
            (std::vector<std::string>{"{} free blocks", "{:.0f} steps"}));
  EXPECT_TRUE(plurals_in("format(\"{} joins blocks {} and {}; {} of {}\", a, b, c)").empty());
}

TEST(Words, CountsAgreeWithTheirNouns) {
  const std::vector<std::filesystem::path> files = repository_files({".cpp", ".hpp"});
  for (const std::filesystem::path& file : files) {
    const std::string name = std::filesystem::relative(file, kRepository).string();
    if (name.starts_with("tests/")) continue;
    for (const std::string& plural : plurals_in(read_text(file)))
      ADD_FAILURE() << name << ": \"" << plural << "\": use counted()";
  }
}

TEST(Words, PhrasesAreFoundAcrossLines) {
  EXPECT_EQ(phrases_in("// The search leads\n  // nowhere."), std::vector<std::string>{"leads nowhere"});
  EXPECT_EQ(phrases_in("f(\"It was in \"\n  \"vain\")"), std::vector<std::string>{"in vain"});
  EXPECT_TRUE(phrases_in("The search diverges.").empty());
}

TEST(Words, NoFileContainsUnwantedPhrases) {
  const std::vector<std::filesystem::path> files =
      repository_files({".cpp", ".hpp", ".c", ".in", ".md", ".py", ".sh", ".gp", ".yaml", ".txt", ".cmake",
                        ".cases", ".json", ".cff"});
  ASSERT_GT(files.size(), 300u);
  for (const std::filesystem::path& file : files) {
    const std::string name = std::filesystem::relative(file, kRepository).string();
    if (name == "CHANGELOG.md" || name == "tests/project/words_test.cpp") continue;
    for (const std::string& phrase : phrases_in(read_text(file)))
      ADD_FAILURE() << name << ": \"" << phrase << "\"";
  }
}

}  // namespace
}  // namespace cupola
