#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "assembly/base/error.hpp"

namespace cupola {

/// A node of a case file: a scalar, a list or a map, with its position. The reader refuses other features of
/// YAML (anchors, tags, merge keys, several documents), so that a case means exactly what it shows.
struct CaseNode {
  enum class Kind { empty, scalar, list, map };
  struct Entry;

  Kind kind = Kind::empty;
  std::string text;             ///< scalar, or the `null` of an empty node, "" if nothing was written
  bool quoted = false;          ///< scalar in quotes: never a number
  std::vector<CaseNode> items;  ///< list
  std::vector<Entry> entries;   ///< map, in the order of the file
  bool of_other_type = false;   ///< inherited by a map whose `type` then changed, which may not have this key
  FileLocation where;

  const CaseNode* find(std::string_view key) const;  ///< nullptr if the map has no such key
  const Entry* find_entry(std::string_view key) const;
};

struct CaseNode::Entry {
  std::string key;
  FileLocation where;  ///< of the key
  CaseNode value;
};

inline CaseNode scalar_node(const std::string& text, bool quoted = false) {
  CaseNode node;
  node.kind = CaseNode::Kind::scalar;
  node.text = text;
  node.quoted = quoted;
  return node;
}

/// Text on one line for a message: control characters become `?`, long text is shortened.
std::string shown(std::string_view text);
/// The same for any node: `[...]` for a list, `{...}` for a map.
std::string shown(const CaseNode& node);

/// Position of the value of a key such as `loads.forces[2].block` below the map, or of the innermost section
/// or item on the way to it that the file gives.
FileLocation place_of(const CaseNode& map, std::string_view key);

/// The map as YAML text, which reads back as the same tree.
std::string to_yaml(const CaseNode& map);

}  // namespace cupola
