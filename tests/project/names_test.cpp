// Names of the libraries: two types of one name in one namespace are undefined behaviour where libraries are
// linked together.

#include <map>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/project/repository.hpp"

namespace cupola::names_test {
namespace {

/// Names of the types that a file defines outside its unnamed namespaces and other types.
std::set<std::string> types_defined_in(const std::string& source) {
  static const std::regex definition(
      R"(^(?:template.*> )?(?:struct|class|union|enum class|enum) ([\w:<>]+).*)");
  std::set<std::string> types;
  std::istringstream lines(source);
  bool unnamed = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "namespace {") unnamed = true;
    if (line == "}  // namespace") unnamed = false;
    const bool only_declared = line.ends_with(";") && line.find('{') == std::string::npos;
    std::smatch match;
    if (!unnamed && !only_declared && std::regex_match(line, match, definition)) types.insert(match[1]);
  }
  return types;
}

TEST(Names, TypesAreFoundWhereTheyAreVisible) {
  const std::string source =
      "struct Declared;\nstruct Box {\n  struct Inner {\n};\nenum class Kind : int { a };\n"
      "template <class T>\nclass List {\nnamespace {\nstruct Hidden {\n}  // namespace\nclass Box::Parts {\n";
  EXPECT_EQ(types_defined_in(source), (std::set<std::string>{"Box", "Box::Parts", "Kind", "List"}));
}

TEST(Names, NoTypeIsDefinedTwice) {
  std::map<std::string, std::filesystem::path> defined;
  for (const char* library : {"assembly", "generators", "solver", "postproc"})
    for (const std::filesystem::path& file : repository_files({".hpp", ".cpp"})) {
      const std::filesystem::path name = std::filesystem::relative(file, kRepository);
      if (*name.begin() != library) continue;
      for (const std::string& type : types_defined_in(read_text(file))) {
        const auto [first, is_new] = defined.try_emplace(type, name);
        EXPECT_TRUE(is_new) << type << " is defined in " << first->second << " and in " << name;
      }
    }
  EXPECT_GT(defined.size(), 300u);  // the folders were found
}

}  // namespace
}  // namespace cupola::names_test
