#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_tree.hpp"
#include "assembly/case/section.hpp"
#include "assembly/case/suggestion.hpp"

namespace cupola {
namespace {

/// Far beyond every quantity of masonry; its powers up to the tenth are finite.
constexpr double kLargestNumber = 1e30;

CaseNode list_of_numbers(const double* values, size_t size) {
  CaseNode node;
  node.kind = CaseNode::Kind::list;
  for (size_t i = 0; i < size; ++i) node.items.push_back(scalar_node(format_number(values[i])));
  return node;
}

/// The file, or those of the folder in the order of their names.
std::vector<std::string> files_at(const std::string& path) {
  if (!std::filesystem::is_directory(path)) return {path};
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(path))
    if (entry.is_regular_file()) files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

std::string format_list(const double* values, size_t size) {
  std::vector<std::string> texts;
  for (size_t i = 0; i < size; ++i) texts.push_back(format_number(values[i]));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

void Section::text(const std::string& key, std::string& value, const std::string& meaning) {
  document(key, "text", {}, fmt::format("\"{}\"", value), meaning);
  if (const CaseNode* node = look_up_scalar(key)) value = node->text;
  record(key, value, true);
}

void Section::read_one_number(const std::string& key, const CaseNode& node, const NumberRule& rule,
                              double* value) const {
  if (node.kind != CaseNode::Kind::scalar || node.quoted) fail(key, node, "must be a number");
  const std::string broken = read_number(node.text, value);
  if (!broken.empty()) fail(key, node, broken + number_hint(node.text));
  if (!admits(rule, *value)) fail(key, node, "must be " + describe_range(rule));
  if (std::abs(*value) > kLargestNumber)
    fail(key, node,
         fmt::format("must be at most {:g} in magnitude, because products of larger numbers overflow",
                     kLargestNumber));
}

void Section::file(const std::string& key, std::string& path, const std::string& meaning, bool or_folder) {
  document(key, or_folder ? "file or folder" : "file", {}, "none", meaning);
  const CaseNode* node = look_up_scalar(key);
  if (!node) return;
  // Of a bundled case that this one extends, or in its effective YAML.
  const bool named = node->text.starts_with(kBundledPrefix);
  const bool bundled = named || (is_bundled(node->where.file) && !is_bundled(case_file_));
  const std::string name = named ? node->text.substr(std::string_view(kBundledPrefix).size()) : node->text;
  const std::string from = bundled ? (std::filesystem::path(bundled_folder()) / "case").string() : case_file_;
  path = path_inside(std::filesystem::path(from).parent_path().string(), from, name, node->where);
  if (!std::filesystem::is_regular_file(path) && !(or_folder && std::filesystem::is_directory(path)))
    fail(key, *node, "no such file in the folder of the case");
  if (files_)
    for (const std::string& one : files_at(path)) files_->push_back({path_of(key), one});
  record(key, bundled ? kBundledPrefix + name : name, true);
}

bool Section::read_number_key(const std::string& key, double& value, const NumberRule& rule) {
  const CaseNode* node = look_up_scalar(key);
  if (node) read_one_number(key, *node, rule, &value);
  record(key, format_number(value));
  return node;
}

void Section::read_one_integer(const std::string& key, const CaseNode& node, const NumberRule& rule,
                               int* value) const {
  if (node.kind != CaseNode::Kind::scalar || node.quoted) fail(key, node, "must be a whole number");
  const std::string broken = read_integer(node.text, value);
  if (!broken.empty()) fail(key, node, broken);
  if (!admits(rule, *value)) fail(key, node, "must be " + describe_range(rule));
}

bool Section::read_integer_key(const std::string& key, int& value, const NumberRule& rule) {
  const CaseNode* node = look_up_scalar(key);
  if (node) read_one_integer(key, *node, rule, &value);
  record(key, std::to_string(value));
  return node;
}

void Section::number(const std::string& key, double& value, const NumberRule& rule,
                     const std::string& meaning, const std::string& shown_default) {
  document(key, "number", rule, shown_default.empty() ? format_number(value) : shown_default, meaning);
  read_number_key(key, value, rule);
}

void Section::settled_number(const std::string& key, double value, const NumberRule& rule) {
  double set_aside = value;
  if (const CaseNode* node = look_up_scalar(key)) read_one_number(key, *node, rule, &set_aside);
  record(key, format_number(value));
}

void Section::required_number(const std::string& key, double& value, const NumberRule& rule,
                              const std::string& meaning) {
  document(key, "number", rule, "required", meaning);
  if (!read_number_key(key, value, rule)) require(key);
}

void Section::optional_number(const std::string& key, std::optional<double>& value, const NumberRule& rule,
                              const std::string& without, const std::string& meaning) {
  document(key, "number", rule, without, meaning);
  const CaseNode* node = look_up_scalar(key);
  if (!node) return;
  read_one_number(key, *node, rule, &value.emplace());
  record(key, format_number(*value));
}

void Section::integer(const std::string& key, int& value, const NumberRule& rule,
                      const std::string& meaning) {
  document(key, "integer", rule, std::to_string(value), meaning);
  read_integer_key(key, value, rule);
}

void Section::required_integer(const std::string& key, int& value, const NumberRule& rule,
                               const std::string& meaning) {
  document(key, "integer", rule, "required", meaning);
  if (!read_integer_key(key, value, rule)) require(key);
}

void Section::flag(const std::string& key, bool& value, const std::string& meaning) {
  document(key, "true, false", {}, value ? "true" : "false", meaning);
  if (const CaseNode* node = look_up_scalar(key)) {
    const std::string broken = node->quoted ? "must be true or false" : read_flag(node->text, &value);
    if (!broken.empty()) fail(key, *node, broken);
  }
  record(key, value ? "true" : "false");
}

bool Section::read_vector3_key(const std::string& key, Eigen::Vector3d& value, const NumberRule& rule) {
  const CaseNode* node = look_up(key);
  if (!node) return false;
  if (node->kind != CaseNode::Kind::list || node->items.size() != 3)
    fail(key, *node, "must be a list of three numbers, [x, y, z]");
  for (int i = 0; i < 3; ++i) read_one_number(key, node->items[static_cast<size_t>(i)], rule, &value[i]);
  return true;
}

void Section::vector3(const std::string& key, Eigen::Vector3d& value, const NumberRule& rule,
                      const std::string& meaning) {
  document(key, "3 numbers", rule, format_list(value.data(), 3), meaning);
  read_vector3_key(key, value, rule);
  record(key, list_of_numbers(value.data(), 3));
}

void Section::optional_vector3(const std::string& key, std::optional<Eigen::Vector3d>& value,
                               const NumberRule& rule, const std::string& without,
                               const std::string& meaning) {
  document(key, "3 numbers", rule, without, meaning);
  Eigen::Vector3d given = Eigen::Vector3d::Zero();
  if (!read_vector3_key(key, given, rule)) return;
  value = given;
  record(key, list_of_numbers(given.data(), 3));
}

BlockRef Section::read_block(const std::string& key, const CaseNode& node) const {
  if (node.kind != CaseNode::Kind::scalar || node.text.empty())
    fail(key, node, "must be the number or the name of a block");
  int number = 0;
  const bool is_integer = read_integer(node.text, &number).empty();
  double other_number = 0.0;
  if (!node.quoted && !is_integer && read_number(node.text, &other_number).empty())
    fail(key, node, "must be a whole number, or a name in quotes");
  if (node.quoted || !is_integer) return BlockRef(node.text);
  if (number < 0) fail(key, node, "must be >= 0");
  return number;
}

void Section::required_block(const std::string& key, BlockRef& value, const std::string& meaning) {
  document(key, "block", {}, "required", meaning);
  const CaseNode* node = look_up_scalar(key);
  if (!node) return require(key);
  value = read_block(key, *node);
  record(key, node->text, node->quoted);
}

void Section::optional_block(const std::string& key, std::optional<BlockRef>& value,
                             const std::string& without, const std::string& meaning) {
  document(key, "block", {}, without, meaning);
  const CaseNode* node = look_up_scalar(key);
  if (!node) return;
  value = read_block(key, *node);
  record(key, node->text, node->quoted);
}

void Section::blocks(const std::string& key, std::vector<BlockRef>& values, const std::string& meaning) {
  document(key, "blocks", {}, "[]", meaning);
  CaseNode list;
  list.kind = CaseNode::Kind::list;
  if (const CaseNode* node = look_up(key)) {
    if (node->kind != CaseNode::Kind::list) fail(key, *node, "must be a list of blocks, [a, b]");
    values.clear();
    for (const CaseNode& item : node->items) {
      values.push_back(read_block(key, item));
      list.items.push_back(scalar_node(item.text, item.quoted));
    }
  }
  record(key, std::move(list));
}

void Section::numbers(const std::string& key, std::vector<double>& values, const NumberRule& rule,
                      const std::string& meaning) {
  document(key, "numbers", rule, format_list(values.data(), values.size()), meaning);
  if (const CaseNode* node = look_up(key)) {
    if (node->kind != CaseNode::Kind::list) fail(key, *node, "must be a list of numbers, [a, b]");
    values.assign(node->items.size(), 0.0);
    for (size_t i = 0; i < values.size(); ++i) read_one_number(key, node->items[i], rule, &values[i]);
  }
  record(key, list_of_numbers(values.data(), values.size()));
}

void Section::texts(const std::string& key, std::vector<std::string>& values, const std::string& meaning) {
  document(key, "texts", {}, fmt::format("[{}]", fmt::join(values, ", ")), meaning);
  if (const CaseNode* node = look_up(key)) {
    if (node->kind != CaseNode::Kind::list) fail(key, *node, "must be a list of names, [a, b]");
    values.clear();
    for (const CaseNode& item : node->items) {
      if (item.kind != CaseNode::Kind::scalar) fail(key, item, "must be a name");
      values.push_back(item.text);
    }
  }
  CaseNode list;
  list.kind = CaseNode::Kind::list;
  for (const std::string& value : values) list.items.push_back(scalar_node(value, true));
  record(key, list);
}

void Section::quantity(double& value, const std::vector<UnitName>& names) {
  const UnitName* given = nullptr;
  for (const UnitName& name : names) {
    document(name.key, "number", name.rule,
             &name == &names.front() ? format_number(value) : "instead of " + names.front().key,
             name.meaning);
    const CaseNode* node = look_up_scalar(name.key);
    if (!node) continue;
    if (given) fail(name.key, *node, fmt::format("give {} or {}, not both", given->key, name.key));
    given = &name;
    double number = 0.0;
    read_one_number(name.key, *node, name.rule, &number);
    value = name.factor * number;
  }
  record(names.front().key, format_number(value));
}

int Section::choose(const std::string& key, const std::vector<std::string>& names, int default_index,
                    const std::string& meaning, const std::string& advice) {
  const bool required = default_index < 0;
  const std::string choices = fmt::format("{}", fmt::join(names, ", "));
  document(key, choices, {}, required ? "required" : names[static_cast<size_t>(default_index)], meaning);
  int chosen = default_index;
  if (const CaseNode* node = look_up_scalar(key)) {
    const auto found = std::find(names.begin(), names.end(), node->text);
    if (found == names.end()) {
      const std::string near = nearest_name(node->text, names);
      fail(key, *node,
           (near.empty() ? "must" : fmt::format("did you mean {}? It must", near)) + " be one of " + choices);
    }
    chosen = static_cast<int>(found - names.begin());
  } else if (required) {
    require(key, advice.empty() ? "; give one of " + choices : "; " + advice);
  }
  if (chosen >= 0) record(key, names[static_cast<size_t>(chosen)]);
  return chosen;
}

}  // namespace cupola
