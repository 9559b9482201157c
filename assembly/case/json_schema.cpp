#include <algorithm>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "assembly/case/schema_table.hpp"

namespace cupola {
namespace {

using Object = nlohmann::ordered_json;

/// A key of the case file with the keys below it.
struct SchemaKey {
  std::vector<const SchemaRow*>
      rows;  ///< one per type that it may have, and one per alternative of a section
  std::vector<std::string> order;
  std::map<std::string, SchemaKey> below;

  SchemaKey& operator[](const std::string& name) {
    const auto [key, is_new] = below.try_emplace(name);
    if (is_new) order.push_back(name);
    return key->second;
  }
};

Object object_of(const SchemaKey& key);

/// Limits such as "> 0 and <= 1".
void add_range(const std::string& range, Object* number) {
  std::istringstream words(range);
  double limit = 0.0;
  for (std::string word; words >> word;) {
    if (word == ">=" && words >> limit) (*number)["minimum"] = limit;
    if (word == "<=" && words >> limit) (*number)["maximum"] = limit;
    if (word == ">" && words >> limit) (*number)["exclusiveMinimum"] = limit;
    if (word == "<" && words >> limit) (*number)["exclusiveMaximum"] = limit;
  }
}

Object names_of(const std::string& list) {
  Object names = Object::array();
  std::istringstream in(list);
  for (std::string name; std::getline(in, name, ',');)
    names.push_back(name.substr(name.find_first_not_of(' ')));
  return {{"enum", names}};
}

Object type_of(const SchemaRow& row, const SchemaKey& key) {
  const std::string& type = row.type;
  const Object text = {{"type", {"string", "number", "boolean"}}};
  const auto array_of = [](const Object& items) -> Object { return {{"type", "array"}, {"items", items}}; };
  if (type == "map") return object_of(key);
  if (type == "list of maps") return array_of(object_of(key));
  if (type == "list of maps or names") return array_of({{"anyOf", {object_of(key), {{"type", "string"}}}}});
  if (type == "text" || type == "block" || type.starts_with("file")) return text;
  if (type == "texts" || type == "blocks") return array_of(text);
  if (type == "true, false") return {{"type", "boolean"}};
  const bool whole = type.starts_with("integer");
  if (!whole && type.find("number") == std::string::npos) return names_of(type);
  Object number = {{"type", whole ? "integer" : "number"}};
  add_range(row.range, &number);
  if (type == "number" || type == "integer") return number;
  Object numbers = array_of(number);
  if (type == "3 numbers") numbers["minItems"] = numbers["maxItems"] = 3;
  return numbers;
}

std::string description_of(const SchemaRow& row) {
  std::string text = row.meaning;
  if (!row.unit.empty() && row.unit != "-") text += fmt::format(" [{}]", row.unit);
  if (row.default_value == "required")
    text += "; required";
  else if (!row.default_value.empty())
    text += "; default " + row.default_value;
  return row.condition.empty() ? text : fmt::format("({}) {}", row.condition, text);
}

Object schema_of(const SchemaKey& key) {
  std::vector<Object> types;
  std::string description;
  for (const SchemaRow* row : key.rows) {
    const Object type = type_of(*row, key);
    if (std::ranges::find(types, type) == types.end()) types.push_back(type);
    const std::string line = description_of(*row);
    if (description.find(line) == std::string::npos) description += (description.empty() ? "" : "\n") + line;
  }
  Object schema = types.size() == 1 ? types.front() : Object{{"anyOf", types}};
  schema["description"] = description;
  return schema;
}

Object object_of(const SchemaKey& key) {
  Object properties = Object::object(), items = Object::object();
  for (const std::string& name : key.order) {
    properties[name] = schema_of(key.below.at(name));
    if (properties[name].contains("items"))
      items["^" + name + "\\[[0-9]+\\]$"] =
          Object{{"description", "an item of " + name + " of the case that this one extends"}};
  }
  const bool has_names = key.order.empty();  // of the case, such as the letters of a drawing
  Object object = {{"type", "object"}, {"additionalProperties", has_names}, {"properties", properties}};
  if (!items.empty()) object["patternProperties"] = items;
  return object;
}

}  // namespace

std::string to_json_schema(const SchemaTable& table) {
  SchemaKey root;
  for (const SchemaRow& row : table.rows) {
    SchemaKey* key = &root;
    std::istringstream path(row.path);
    for (std::string name; std::getline(path, name, '.');)
      key = &(*key)[name.ends_with("[]") ? name.substr(0, name.size() - 2) : name];
    key->rows.push_back(&row);
  }
  Object schema = object_of(root);
  schema["properties"]["extends"] = {{"type", "string"},
                                     {"description", "case file whose keys hold where this one gives none"}};
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "Case file of Cupola";
  return schema.dump(1) + "\n";
}

}  // namespace cupola
