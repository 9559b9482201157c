#include "tests/verification/references.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/base/error.hpp"
#include "assembly/case/yaml_text.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/number_text.hpp"

namespace cupola::verification {
namespace {

const std::string kFolder = CUPOLA_SOURCE_DIR "/tests/verification/";

CaseNode read_tree(const std::string& name) {
  return parse_yaml(read_text(kFolder + name), "tests/verification/" + name);
}

double number_in(const std::string& text, const FileLocation& where) {
  double value = 0.0;
  if (const std::string broken = read_number(text, &value); !broken.empty())
    throw InputError(where, text + ": must be a number, " + broken);
  return value;
}

std::string required(const CaseNode& map, const char* key) {
  const CaseNode* node = map.find(key);
  if (!node || node->kind != CaseNode::Kind::scalar)
    throw InputError(map.where, std::string(key) + ": missing text");
  return node->text;
}

void read_expected(const CaseNode& node, ReferenceRow* row) {
  if (node.kind == CaseNode::Kind::list && node.items.size() == 2) {
    row->low = number_in(node.items[0].text, node.where);
    row->high = number_in(node.items[1].text, node.where);
    row->expected_text = node.items[0].text + " to " + node.items[1].text;
    if (!(row->low < row->high)) throw InputError(node.where, "expected: must be [low, high]");
    return;
  }
  row->low = row->high = number_in(node.text, node.where);
  row->expected_text = node.text;
}

ReferenceRow read_row(const CaseNode& map) {
  ReferenceRow row;
  if (!map.find("expected")) throw InputError(map.where, "expected: missing");
  for (const CaseNode::Entry& entry : map.entries) {
    if (entry.key == "expected")
      read_expected(entry.value, &row);
    else if (entry.key == "slow")
      row.slow = entry.value.text == "true";
    else if (entry.key == "why")
      row.why = entry.value.text;
    else
      row.parameters.emplace_back(entry.key, entry.value.text);
  }
  return row;
}

Reference read_reference(const CaseNode::Entry& entry) {
  const CaseNode& map = entry.value;
  Reference r;
  r.id = entry.key;
  const std::pair<const char*, std::string*> fields[] = {
      {"chapter", &r.chapter},   {"group", &r.group},   {"title", &r.title}, {"statement", &r.statement},
      {"quantity", &r.quantity}, {"source", &r.source}, {"error", &r.error}, {"reason", &r.reason}};
  for (const auto& [key, text] : fields) *text = required(map, key);
  r.tolerance = number_in(required(map, "tolerance"), map.where);
  const CaseNode* rows = map.find("rows");
  if (!rows || rows->items.empty()) throw InputError(map.where, entry.key + ": has no rows");
  for (const CaseNode& row : rows->items) r.rows.push_back(read_row(row));
  if (r.error != "relative" && r.error != "absolute")
    throw InputError(map.where, "error: must be relative or absolute");
  if (map.entries.size() != std::size(fields) + 2)
    throw InputError(map.where, entry.key + ": has an unknown key");
  return r;
}

}  // namespace

bool ReferenceRow::has(const std::string& parameter) const {
  return std::any_of(parameters.begin(), parameters.end(),
                     [&](const auto& pair) { return pair.first == parameter; });
}

std::string ReferenceRow::text(const std::string& parameter) const {
  for (const auto& [name, value] : parameters)
    if (name == parameter) return value;
  throw InputError("tests/verification/references.yaml: a row has no parameter " + parameter);
}

double ReferenceRow::number(const std::string& parameter) const {
  return number_in(text(parameter), {"tests/verification/references.yaml", 0, 0});
}

int ReferenceRow::integer(const std::string& parameter) const {
  return static_cast<int>(std::lround(number(parameter)));
}

std::string ReferenceRow::name() const {
  std::string out;
  for (const auto& [key, value] : parameters) {
    std::string words = key == "t_R" ? "t/R" : key;
    std::replace(words.begin(), words.end(), '_', ' ');
    out += (out.empty() ? "" : ", ") + words + " " + value;
  }
  return out;
}

const std::vector<Reference>& references() {
  static const std::vector<Reference> all = [] {
    std::vector<Reference> read;
    const CaseNode tree = read_tree("references.yaml");
    for (const CaseNode::Entry& entry : tree.entries) read.push_back(read_reference(entry));
    return read;
  }();
  return all;
}

const Reference& reference(const std::string& id) {
  for (const Reference& r : references())
    if (r.id == id) return r;
  throw InputError("tests/verification/references.yaml: no problem " + id);
}

std::vector<std::pair<std::string, std::string>> manual_text(const std::string& list) {
  const CaseNode tree = read_tree("manual_text.yaml");
  const CaseNode* found = tree.find(list);
  if (!found) throw InputError("tests/verification/manual_text.yaml: no list " + list);
  std::vector<std::pair<std::string, std::string>> items;
  for (const CaseNode& item : found->items)
    items.emplace_back(required(item, "topic"), required(item, "text"));
  return items;
}

}  // namespace cupola::verification
