// The mistakes of docs/mistakes.md, repeated as they are printed there: each ```yaml block is a file, named
// in its first line, each ```console block holds commands and what they print.

#include <cstdlib>
#include <regex>

#include "tests/pipeline/program_run.hpp"

namespace cupola::mistakes_test {
namespace {

/// A command and what the document says it prints.
struct Typed {
  std::string command, shown;
};

/// A fenced block of the document: its language and its text.
struct Fence {
  std::string language, text;
};

/// The parts of a text that begin with `start`.
std::vector<std::string> parts_of(const std::string& text, const std::string& start) {
  std::vector<std::string> parts;
  for (size_t at = text.find(start); at != std::string::npos;) {
    const size_t next = text.find(start, at + start.size());
    parts.push_back(text.substr(at, next - at));
    at = next;
  }
  return parts;
}

std::vector<Fence> fences_of(const std::string& text) {
  std::vector<Fence> fences;
  static const std::regex pattern("```([a-z]+)\n([^`]*)```");
  for (std::sregex_iterator i(text.begin(), text.end(), pattern); i != std::sregex_iterator(); ++i)
    fences.push_back({(*i)[1], (*i)[2]});
  return fences;
}

/// The commands of a console block, and the lines below each.
std::vector<Typed> commands_of(const std::string& console) {
  std::vector<Typed> commands;
  std::istringstream lines(console);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("$ "))
      commands.push_back({line.substr(2), ""});
    else if (!commands.empty())
      commands.back().shown += line + "\n";
  }
  return commands;
}

/// One blank for each run of blanks and line breaks: the document wraps long lines.
std::string on_one_line(const std::string& text) {
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

/// True if `printed` is `shown`, in which "..." stands for any text.
bool agrees(const std::string& printed, const std::string& shown) {
  static const std::string kDots = "...";
  std::string rest = on_one_line(printed), pattern = on_one_line(shown);
  for (bool anchored = true;;) {
    const size_t dots = pattern.find(kDots);
    if (dots == std::string::npos) return anchored ? rest == pattern : rest.ends_with(pattern);
    const std::string part = pattern.substr(0, dots);
    const size_t at = rest.find(part);
    if (at == std::string::npos || (anchored && at != 0)) return false;
    rest = rest.substr(at + part.size());
    pattern = pattern.substr(dots + kDots.size());
    anchored = false;
  }
}

TEST(Mistakes, TheComparisonIsExactExceptAtDots) {
  EXPECT_TRUE(agrees("error: one two three\n", "error: one\n    two three\n"));
  EXPECT_TRUE(agrees("Makefile:12: *** error.\n", "... error.\n"));
  EXPECT_TRUE(agrees("error: one; valid: two\n", "error: one; ...\n"));
  EXPECT_FALSE(agrees("error: one two\n", "error: one\n"));
  EXPECT_FALSE(agrees("error: one\n", "error: ... two\n"));
  EXPECT_FALSE(agrees("error: one\n", "one\n"));
  EXPECT_FALSE(agrees("", "error\n"));
}

/// Writes the file of a yaml block, whose first line names it: "# my_dome.yaml".
void write_file(const ProgramFolder& folder, const std::string& text) {
  ASSERT_TRUE(text.starts_with("# ")) << text;
  std::ofstream(folder.file(text.substr(2, text.find('\n') - 2))) << text;
}

TEST(Mistakes, TheDocumentShowsWhatTheProgramsPrint) {
  ::unsetenv("MAKEFLAGS");  // of a make that runs the tests
  ::unsetenv("MAKELEVEL");
  const std::string document = slurp(CUPOLA_SOURCE_DIR "/docs/mistakes.md");
  const std::vector<std::string> mistakes = parts_of(document, "\n## ");
  ASSERT_EQ(mistakes.size(), 10u);
  const ProgramFolder folder;
  std::filesystem::create_directory_symlink(CUPOLA_SOURCE_DIR, folder.file("cupola"));
  for (const std::string& mistake : mistakes) {
    const std::string title = mistake.substr(1, mistake.find('\n', 1) - 1);
    int noticed = 0;
    for (const Fence& fence : fences_of(mistake)) {
      if (fence.language == "yaml") write_file(folder, fence.text);
      if (fence.language != "console") continue;
      for (const Typed& typed : commands_of(fence.text)) {
        const ProgramRun run = folder.run(typed.command);
        EXPECT_TRUE(agrees(run.err + run.out, typed.shown))
            << title << "\n$ " << typed.command << "\nprints\n"
            << run.err << run.out << "the document shows\n"
            << typed.shown;
        noticed += run.code == 2 || run.err.find("warning: ") != std::string::npos;
      }
    }
    EXPECT_GT(noticed, 0) << title << ": no program notices it";
  }
}

}  // namespace
}  // namespace cupola::mistakes_test
