// Phrases that the repository's texts must not contain, because readers stumbled over them.

#include <cctype>

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
