// Every key of the schema is set by a shipped case or variant, or listed here.

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/case/case_tree.hpp"

namespace cupola::shipped_keys_test {
namespace {

/// The key paths below a node, with [] for the items of lists.
void add_keys(const CaseNode& node, const std::string& path, std::set<std::string>* keys) {
  if (!path.empty()) keys->insert(path);
  for (const CaseNode& item : node.items)
    if (item.kind == CaseNode::Kind::map || item.kind == CaseNode::Kind::list)
      add_keys(item, path + "[]", keys);
  for (const CaseNode::Entry& entry : node.entries)
    add_keys(entry.value, path.empty() ? entry.key : path + "." + entry.key, keys);
}

std::set<std::string> shipped_keys() {
  std::set<std::string> keys;
  const std::string folder = bundled_folder();
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".yaml") add_keys(load_case_tree(entry.path().string(), {}), "", &keys);
  std::ifstream variants(folder + "/variants.txt");
  for (std::string line; std::getline(variants, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    std::string name, base;
    words >> name >> base;
    std::vector<std::string> settings;
    for (std::string word; words >> word;)
      if (!word.starts_with("--")) settings.push_back(word);
    add_keys(load_case_tree(folder + "/" + base + ".yaml", settings), "", &keys);
  }
  return keys;
}

/// One declaration may serve several sections: it counts as set where one of them is.
std::string declaration_of(const SchemaRow& row) {
  return row.path.substr(row.path.find_last_of('.') + 1) + "|" + row.type + "|" + row.unit + "|" + row.range +
         "|" + row.meaning;
}

// Keys without a shipped case, with the reason. Add none.
const std::set<std::string> kWithoutCase = {
    "analysis.max_iterations",  // shows only where a run misses its tolerance
};

TEST(Schema, EveryKeyIsSetByAShippedCase) {
  const std::set<std::string> shipped = shipped_keys();
  const SchemaTable schema = case_schema_table();
  std::set<std::string> set_declarations, without_case;
  for (const SchemaRow& row : schema.rows)
    if (shipped.contains(row.path)) set_declarations.insert(declaration_of(row));
  for (const SchemaRow& row : schema.rows)
    if (!set_declarations.contains(declaration_of(row))) without_case.insert(row.path);
  for (const std::string& key : without_case)
    EXPECT_TRUE(kWithoutCase.contains(key))
        << key << " is set by no shipped case: add one, or retire the key";
  for (const std::string& key : kWithoutCase)
    EXPECT_TRUE(without_case.contains(key)) << key << " has a shipped case: remove it from the list";
}

}  // namespace
}  // namespace cupola::shipped_keys_test
