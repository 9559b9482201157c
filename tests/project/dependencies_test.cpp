// The structure of the repository: which folder includes which, against the table in docs/architecture.md.

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cupola::dependencies_test {
namespace {

namespace fs = std::filesystem;

struct Row {
  std::string folder;
  std::vector<std::string> may_include;
};

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> all;
  for (std::string word; in >> word;) all.push_back(word);
  return all;
}

/// The rows of the table whose first column is a folder of sources.
std::vector<Row> read_table(const fs::path& page) {
  std::vector<Row> rows;
  std::ifstream in(page);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("| ")) continue;
    std::istringstream cells(line.substr(2));
    std::string folder, may_include;
    std::getline(cells, folder, '|');
    std::getline(cells, may_include, '|');
    const std::string name = words(folder).front();
    const std::string top = name.substr(0, name.find('/'));
    if (top == "assembly" || top == "generators" || top == "solver" || top == "postproc")
      rows.push_back({name, words(may_include)});
  }
  return rows;
}

bool is_within(const std::string& folder, const std::string& parent) {
  return folder == parent || folder.starts_with(parent + "/");
}

/// Why a file of `folder` must not include a header of `included`; empty when it may.
std::string objection(const std::vector<Row>& table, const std::string& folder, const std::string& included) {
  if (folder == included) return "";
  for (const Row& row : table) {
    if (row.folder != folder) continue;
    for (const std::string& allowed : row.may_include)
      if (is_within(included, allowed)) return "";
    return folder + " must not include " + included;
  }
  return folder + " is missing from the table in docs/architecture.md";
}

std::vector<std::string> included_headers(const fs::path& file) {
  std::vector<std::string> headers;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("#include \"")) headers.push_back(line.substr(10, line.rfind('"') - 10));
  return headers;
}

const fs::path kRoot = CUPOLA_SOURCE_DIR;

TEST(Dependencies, EveryIncludeIsAllowedByTheTable) {
  const std::vector<Row> table = read_table(kRoot / "docs/architecture.md");
  int includes = 0;
  for (const char* top : {"assembly", "generators", "solver", "postproc"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp") continue;
      const fs::path file = fs::relative(entry.path(), kRoot);
      for (const std::string& header : included_headers(entry.path())) {
        ++includes;
        EXPECT_EQ(objection(table, file.parent_path().string(), fs::path(header).parent_path().string()), "")
            << file << " includes " << header;
      }
    }
  EXPECT_GT(includes, 500);  // the folders were found
}

TEST(Dependencies, FoldersDependOnEarlierRowsOnly) {
  const std::vector<Row> table = read_table(kRoot / "docs/architecture.md");
  std::map<std::string, size_t> position;
  for (size_t i = 0; i < table.size(); ++i) position[table[i].folder] = i;
  for (size_t i = 0; i < table.size(); ++i)
    for (const std::string& allowed : table[i].may_include)
      for (size_t j = i + 1; j < table.size(); ++j)
        EXPECT_FALSE(is_within(table[j].folder, allowed))
            << table[i].folder << " may include the later " << table[j].folder;
}

TEST(Dependencies, AForbiddenIncludeIsReported) {
  const std::vector<Row> table{{"solver/contact", {"assembly/model"}}, {"solver/dynamics", {"solver"}}};
  EXPECT_EQ(objection(table, "solver/contact", "assembly/model"), "");
  EXPECT_EQ(objection(table, "solver/contact", "solver/contact"), "");
  EXPECT_EQ(objection(table, "solver/contact", "solver/dynamics"),
            "solver/contact must not include solver/dynamics");
  EXPECT_NE(objection(table, "solver/contact", "assembly/modelling"), "");
  EXPECT_NE(objection(table, "solver/conic", "assembly/model"), "");
}

}  // namespace
}  // namespace cupola::dependencies_test
