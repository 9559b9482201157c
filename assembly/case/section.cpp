#include "assembly/case/section.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/case/suggestion.hpp"

namespace cupola {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The map {type: name} that a bare name stands for.
CaseNode map_of_type(const CaseNode& name) {
  CaseNode map;
  map.kind = CaseNode::Kind::map;
  map.where = name.where;
  map.entries.push_back({"type", name.where, name});
  return map;
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
  const bool is_number = type == "number" || type == "integer" || type == "numbers" || type == "3 numbers";
  schema_->rows.push_back({path_of(key), schema_->condition, type, is_number ? std::string(rule.unit) : "",
                           is_number ? describe_range(rule) : "", default_value, meaning});
}

void Section::record(const std::string& key, const std::string& text, bool quoted) {
  record(key, scalar_node(text, quoted));
}

void Section::record(const std::string& key, CaseNode value) {
  effective_.entries.push_back({key, {}, std::move(value)});
}

void Section::require(const std::string& key, const std::string& hint) {
  if (!describing())
    missing_.emplace_back(where_, fmt::format("{} is missing and has no default{}", path_of(key), hint));
}

std::string Section::misspelling_of(const std::string& key) const {
  std::vector<std::string> given;
  if (node_)
    for (const CaseNode::Entry& entry : node_->entries)
      if (!contains(known_, entry.key) && !entry.value.of_other_type) given.push_back(entry.key);
  const std::string near = nearest_name(key, given);
  return near.empty() ? "" : fmt::format("; is {} a misspelling of {}?", shown(near), key);
}

void Section::fail_without(const std::string& key) const {
  throw InputError(where_, missing_.back().second + misspelling_of(key));
}

void Section::expect(PlausibleRange range) const {
  if (!expected_) return;
  range.key = range.key.starts_with(' ') ? path_ + range.key : path_of(range.key);
  expected_->push_back(std::move(range));
}

void Section::retired(const std::string& key, const std::string& instead) const {
  refuse(key, "this key no longer exists; " + instead);
}

void Section::refuse(const std::string& key, const std::string& advice) const {
  const CaseNode* node = node_ ? node_->find(key) : nullptr;
  if (!node || node->of_other_type) return;
  const std::string& file = node->where.file;
  const bool inherited = file != case_file_ && file.ends_with(".yaml");
  fail(key, *node,
       inherited ? fmt::format("{}; it is inherited: write {}: null", advice, path_of(key)) : advice);
}

void Section::open(const std::string& key, const std::string& meaning, const DeclareKeys& declare) {
  document(key, "map", {}, "", meaning);
  const CaseNode* node = look_up(key);
  Section child(node, path_of(key), node ? node->where : where_, case_file_);
  child.parent_ = this;
  child.schema_ = schema_;
  child.files_ = files_;
  child.expected_ = expected_;
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
      item.expected_ = expected_;
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

bool Section::is_empty() const {
  return !describing() && (!node_ || node_->entries.empty());
}

void Section::rule(bool holds, const std::string& key, const std::string& text) const {
  if (holds || describing()) return;
  const CaseNode* node = node_ ? node_->find(key) : nullptr;
  if (node) fail(key, *node, text);
  throw InputError(node_ ? place_of(*node_, key) : where_,
                   fmt::format("{}: {}{}", path_of(key), text, misspelling_of(key)));
}

void Section::close(const Section& child) {
  child.check_names();
  missing_.insert(missing_.end(), child.missing_.begin(), child.missing_.end());
}

void Section::check_names() const {
  if (node_) {
    for (const auto& [key, where, value] : node_->entries) {
      if (contains(known_, key) || value.of_other_type) continue;
      const std::string near = nearest_name(key, known_);
      const std::string elsewhere = suggestion_for(*node_, key, path_of(key));
      const std::string meant = !elsewhere.empty() && (near.empty() || edit_distance(key, near) > 1)
                                    ? elsewhere
                                : near.empty() ? "."
                                               : fmt::format("; did you mean {}?", near);
      throw InputError(where, fmt::format("{}: unknown key{} Valid keys here: {}", shown(path_of(key)), meant,
                                          fmt::join(known_, ", ")));
    }
  }
}

void Section::finish() const {
  check_names();
  if (!missing_.empty()) throw InputError(missing_.front().first, missing_.front().second);
}

}  // namespace cupola
