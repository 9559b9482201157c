// Every relative link in the Markdown files of the repository leads to an existing file and, if it names one,
// to an existing heading. Every header that a text names exists.

#include <cctype>
#include <map>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/project/repository.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

/// The lines outside fenced code blocks, with code spans removed.
std::vector<std::string> lines_of_prose(const std::string& markdown) {
  static const std::regex code_span("`[^`]*`");
  std::vector<std::string> lines;
  std::istringstream text(markdown);
  bool fenced = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("```")) {
      fenced = !fenced;
    } else if (!fenced) {
      lines.push_back(line.starts_with('#') ? line : std::regex_replace(line, code_span, ""));
    }
  }
  return lines;
}

/// The anchor that GitHub gives to a heading: lower case, punctuation dropped, spaces replaced by hyphens.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80) {
      anchor += static_cast<char>(std::tolower(byte));
    } else if (c == ' ') {
      anchor += '-';
    }
  }
  return anchor;
}

/// Repeated headings are numbered: `usage`, `usage-1`, ...
std::set<std::string> anchors_of(const std::string& markdown) {
  std::set<std::string> anchors;
  std::map<std::string, int> count;
  for (const std::string& line : lines_of_prose(markdown)) {
    const std::size_t level = line.find_first_not_of('#');
    if (level == 0 || level == std::string::npos || line[level] != ' ') continue;
    const std::string anchor = anchor_of(line.substr(level + 1));
    const int previous = count[anchor]++;
    anchors.insert(previous == 0 ? anchor : anchor + "-" + std::to_string(previous));
  }
  return anchors;
}

std::vector<std::string> link_targets(const std::string& markdown) {
  static const std::regex link(R"(\]\(([^)\s]+)(\s+"[^"]*")?\))");
  std::vector<std::string> targets;
  for (const std::string& line : lines_of_prose(markdown)) {
    for (std::sregex_iterator i(line.begin(), line.end(), link), end; i != end; ++i)
      targets.push_back((*i)[1]);
  }
  return targets;
}

/// Why a link of a file does not resolve; empty if it does. Links to the web are not followed.
std::string broken(const fs::path& file, const std::string& target) {
  if (target.find("://") != std::string::npos || target.starts_with("mailto:")) return "";
  const std::size_t hash = target.find('#');
  const std::string path = target.substr(0, hash);
  const fs::path destination = path.empty() ? file : file.parent_path() / path;
  if (!fs::exists(destination)) return "no such file";
  if (hash == std::string::npos) return "";
  if (destination.extension() != ".md") return "anchors are checked in Markdown files only";
  return anchors_of(read_text(destination)).contains(target.substr(hash + 1)) ? "" : "no such heading";
}

TEST(Links, AnchorsFollowTheRulesOfGitHub) {
  const std::string markdown =
      "# What holds: always\n```\n# no heading\n```\n## Use `make`\n## Use `make`\n#no heading\n\n";
  EXPECT_EQ(anchors_of(markdown), (std::set<std::string>{"what-holds-always", "use-make", "use-make-1"}));
}

TEST(Links, BrokenLinksAreFound) {
  const fs::path readme = kRepository / "README.md";
  EXPECT_EQ(broken(readme, "https://example.org/nothing"), "");
  EXPECT_EQ(broken(readme, "cases/README.md"), "");
  EXPECT_EQ(broken(readme, "cases/NO_SUCH_FILE.md"), "no such file");
  EXPECT_EQ(broken(readme, "cases/README.md#no-such-heading"), "no such heading");
  EXPECT_EQ(link_targets("[a](b.md) `[c](d.md)` ![e](f.png \"title\")"),
            (std::vector<std::string>{"b.md", "f.png"}));
}

// Comments and pages name headers by file name or by path from the root.
TEST(Links, EveryNamedHeaderExists) {
  static const std::regex header("[A-Za-z0-9_/]+\\.hpp");
  std::set<std::string> existing = {"postproc/pictures/paraview_text.hpp",
                                    "postproc/viewer/packed_scripts.hpp",
                                    "postproc/viewer/viewer_text.hpp"};  // written by the build
  for (const fs::path& file : repository_files({".hpp"})) {
    for (fs::path path = fs::relative(file, kRepository); !path.empty();) {
      existing.insert(path.string());
      const std::string text = path.string();
      const std::size_t slash = text.find('/');
      path = slash == std::string::npos ? fs::path() : fs::path(text.substr(slash + 1));
    }
  }
  for (const fs::path& file : repository_files({".cpp", ".hpp", ".md"})) {
    std::istringstream text(read_text(file));
    for (std::string line; std::getline(text, line);) {
      if (line.starts_with("#include <")) continue;
      for (std::sregex_iterator i(line.begin(), line.end(), header), end; i != end; ++i) {
        EXPECT_TRUE(existing.contains(i->str()))
            << fs::relative(file, kRepository).string() << ": " << i->str();
      }
    }
  }
}

TEST(Links, EveryRelativeLinkResolves) {
  const std::vector<fs::path> files = repository_files({".md"});
  ASSERT_GT(files.size(), 5u);
  for (const fs::path& file : files) {
    for (const std::string& target : link_targets(read_text(file))) {
      const std::string fault = broken(file, target);
      EXPECT_TRUE(fault.empty()) << fs::relative(file, kRepository).string() << ": " << target << ": "
                                 << fault;
    }
  }
}

}  // namespace
}  // namespace cupola
