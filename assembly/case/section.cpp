#include "assembly/case/section.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "assembly/case/bundled.hpp"
#include "assembly/case/case_tree.hpp"
#include "assembly/case/suggestion.hpp"

namespace cupola {
namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

CaseNode scalar(const std::string& text, bool quoted = false) {
  CaseNode node;
  node.kind = CaseNode::Kind::scalar;
  node.text = text;
  node.quoted = quoted;
  return node;
}

/// The map {type: name} that a bare name stands for.
CaseNode map_of_type(const CaseNode& name) {
  CaseNode map;
  map.kind = CaseNode::Kind::map;
  map.where = name.where;
  map.entries.push_back({"type", name.where, name});
  return map;
}

CaseNode list_of_numbers(const double* values, size_t size) {
  CaseNode node;
  node.kind = CaseNode::Kind::list;
  for (size_t i = 0; i < size; ++i) node.items.push_back(scalar(format_number(values[i])));
  return node;
}

std::string format_list(const double* values, size_t size) {
  std::vector<std::string> texts;
  for (size_t i = 0; i < size; ++i) texts.push_back(format_number(values[i]));
  return fmt::format("[{}]", joined(texts));
}

}  // namespace

Section::Section(const CaseNode* node, std::string path, FileLocation where, std::string case_file)
    : node_(node), path_(std::move(path)), where_(std::move(where)), case_file_(std::move(case_file)) {
  effective_.kind = CaseNode::Kind::map;
  if (node_ && node_->kind != CaseNode::Kind::map)
    throw InputError(node_->where,
                     fmt::format("{} = {}: must be a map, {{key: value}}", path_, shown(*node_)));
}

Section::Section(SchemaTable* schema, std::string path) : schema_(schema), path_(std::move(path)) {
  effective_.kind = CaseNode::Kind::map;
}

std::string Section::path_of(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

void Section::fail(const std::string& key, const CaseNode& node, const std::string& rule) const {
  throw InputError(node.where, fmt::format("{} = {}: {}", path_of(key), shown(node), rule));
}

const CaseNode* Section::look_up(const std::string& key) {
  if (!contains(known_, key)) known_.push_back(key);
  const CaseNode* node = node_ ? node_->find(key) : nullptr;
  if (node && node->kind == CaseNode::Kind::empty)
    throw InputError(node->where, fmt::format("{} is empty: give a value or remove the key", path_of(key)));
  return node;
}

const CaseNode* Section::look_up_scalar(const std::string& key) {
  const CaseNode* node = look_up(key);
  if (node && node->kind != CaseNode::Kind::scalar)
    fail(key, *node, "must be a single value, not a list or a map");
  return node;
}

void Section::document(const std::string& key, const std::string& type, const NumberRule& rule,
                       const std::string& default_value, const std::string& meaning) {
  if (!describing()) return;
  const bool is_number =
      type == "number" || type == "integer" || type == "numbers" || type == "integers" || type == "3 numbers";
  schema_->rows.push_back({path_of(key), schema_->condition, type, is_number ? std::string(rule.unit) : "",
                           is_number ? describe_range(rule) : "", default_value, meaning});
}

void Section::record(const std::string& key, const std::string& text, bool quoted) {
  record(key, scalar(text, quoted));
}

void Section::record(const std::string& key, CaseNode value) {
  effective_.entries.push_back({key, {}, std::move(value)});
}

void Section::require(const std::string& key, const std::string& hint) {
  if (!describing())
    missing_.emplace_back(where_, fmt::format("{} is missing and has no default{}", path_of(key), hint));
}

void Section::fail_without(const std::string& key) const {
  std::vector<std::string> given;
  if (node_)
    for (const CaseNode::Entry& entry : node_->entries) given.push_back(entry.key);
  const std::string near = nearest_name(key, given);
  throw InputError(where_,
                   missing_.back().second +
                       (near.empty() ? "" : fmt::format("; is {} a misspelling of it?", shown(near))));
}

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
}

void Section::file(const std::string& key, std::string& path, const std::string& meaning, bool or_folder) {
  document(key, or_folder ? "file or folder" : "file", {}, "none", meaning);
  const CaseNode* node = look_up_scalar(key);
  if (!node) return;
  const std::string& from = is_bundled(node->where.file) ? node->where.file : case_file_;
  path = path_inside(std::filesystem::path(from).parent_path().string(), from, node->text, node->where);
  if (!std::filesystem::is_regular_file(path) && !(or_folder && std::filesystem::is_directory(path)))
    fail(key, *node, "no such file in the folder of the case");
  if (files_) files_->push_back(path);
  record(key, node->text, true);
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

void Section::integers(const std::string& key, std::vector<int>& values, const NumberRule& rule,
                       const std::string& meaning) {
  std::vector<double> shown_values(values.begin(), values.end());
  document(key, "integers", rule, format_list(shown_values.data(), shown_values.size()), meaning);
  if (const CaseNode* node = look_up(key)) {
    if (node->kind != CaseNode::Kind::list) fail(key, *node, "must be a list of whole numbers, [1, 2]");
    values.assign(node->items.size(), 0);
    for (size_t i = 0; i < values.size(); ++i) read_one_integer(key, node->items[i], rule, &values[i]);
  }
  shown_values.assign(values.begin(), values.end());
  record(key, list_of_numbers(shown_values.data(), shown_values.size()));
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
      list.items.push_back(scalar(item.text, item.quoted));
    }
  }
  record(key, std::move(list));
}

void Section::retired(const std::string& key, const std::string& instead) const {
  refuse(key, "this key no longer exists; " + instead);
}

void Section::refuse(const std::string& key, const std::string& advice) const {
  const CaseNode* node = node_ ? node_->find(key) : nullptr;
  if (node) fail(key, *node, advice);
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
  document(key, "texts", {}, fmt::format("[{}]", joined(values)), meaning);
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
  for (const std::string& value : values) list.items.push_back(scalar(value, true));
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
  document(key, joined(names), {}, required ? "required" : names[static_cast<size_t>(default_index)],
           meaning);
  int chosen = default_index;
  if (const CaseNode* node = look_up_scalar(key)) {
    const auto found = std::find(names.begin(), names.end(), node->text);
    if (found == names.end()) {
      const std::string near = nearest_name(node->text, names);
      fail(key, *node,
           (near.empty() ? "must" : fmt::format("did you mean {}? It must", near)) + " be one of " +
               joined(names));
    }
    chosen = static_cast<int>(found - names.begin());
  } else if (required) {
    require(key, advice.empty() ? "; give one of " + joined(names) : "; " + advice);
  }
  if (chosen >= 0) record(key, names[static_cast<size_t>(chosen)]);
  return chosen;
}

void Section::open(const std::string& key, const std::string& meaning, const DeclareKeys& declare) {
  document(key, "map", {}, "", meaning);
  const CaseNode* node = look_up(key);
  Section child(node, path_of(key), node ? node->where : where_, case_file_);
  child.parent_ = this;
  child.schema_ = schema_;
  child.files_ = files_;
  declare(child);
  close(child);
  record(key, child.effective());
}

bool Section::open_optional(const std::string& key, const std::string& meaning, const DeclareKeys& declare) {
  if (!describing() && !look_up(key)) return false;
  open(key, meaning, declare);
  return !describing();
}

void Section::open_list(const std::string& key, Items kind, const std::string& meaning,
                        const DeclareKeys& declare_item) {
  document(key, kind == Items::maps ? "list of maps" : "list of maps or names", {}, "[]", meaning);
  if (describing()) {
    Section item(schema_, path_of(key) + "[]");
    declare_item(item);
    return;
  }
  CaseNode values;
  values.kind = CaseNode::Kind::list;
  if (const CaseNode* node = look_up(key)) {
    if (node->kind != CaseNode::Kind::list) fail(key, *node, "must be a list of maps");
    for (size_t i = 0; i < node->items.size(); ++i) {
      const bool named = kind == Items::maps_or_names && node->items[i].kind == CaseNode::Kind::scalar;
      const CaseNode given = named ? map_of_type(node->items[i]) : node->items[i];
      Section item(&given, fmt::format("{}[{}]", path_of(key), i), given.where, case_file_);
      item.files_ = files_;
      declare_item(item);
      close(item);
      values.items.push_back(item.effective());
    }
  }
  record(key, std::move(values));
}

void Section::describe_alternative(const std::string& key, const std::string& name,
                                   const std::string& meaning, const DeclareKeys& declare) {
  schema_->condition = fmt::format("{}: {}", key, name);
  schema_->rows.push_back({path_, schema_->condition, "map", "", "", "", meaning});
  declare(*this);
  schema_->condition.clear();
}

bool Section::gives(const std::string& key) const {
  const CaseNode* node = node_ ? node_->find(key) : nullptr;
  return node && (node->kind != CaseNode::Kind::list || !node->items.empty());
}

void Section::rule(bool holds, const std::string& key, const std::string& text) const {
  if (holds || describing()) return;
  const CaseNode* node = node_ ? node_->find(key) : nullptr;
  if (node) fail(key, *node, text);
  throw InputError(where_, fmt::format("{}: {}", path_of(key), text));
}

void Section::close(const Section& child) {
  child.check_names();
  missing_.insert(missing_.end(), child.missing_.begin(), child.missing_.end());
}

void Section::check_names() const {
  if (node_) {
    for (const auto& [key, where, value] : node_->entries) {
      if (contains(known_, key)) continue;
      const std::string near = nearest_name(key, known_);
      const std::string elsewhere = suggestion_for(*node_, key, path_of(key));
      const std::string meant = !elsewhere.empty() && (near.empty() || edit_distance(key, near) > 1)
                                    ? elsewhere
                                : near.empty() ? "."
                                               : fmt::format("; did you mean {}?", near);
      throw InputError(where, fmt::format("{}: unknown key{} Valid keys here: {}", shown(path_of(key)), meant,
                                          joined(known_)));
    }
  }
}

void Section::finish() const {
  check_names();
  if (!missing_.empty()) throw InputError(missing_.front().first, missing_.front().second);
}

}  // namespace cupola
