#include "assembly/case/case_node.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <system_error>

#include <fmt/format.h>

namespace cupola {
namespace {

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\x{:02x}", c);
    } else {
      out += c;
    }
  }
  return out + '"';
}

/// Keys are words, but for the letters of a drawn bond, which can be any.
std::string key_text(const std::string& key) {
  const auto of_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return std::ranges::all_of(key, of_word) ? key : in_quotes(key);
}

std::string flow(const CaseNode& node) {
  const bool is_list = node.kind == CaseNode::Kind::list;
  if (!is_list && node.kind != CaseNode::Kind::map) return node.quoted ? in_quotes(node.text) : node.text;
  std::string out;
  for (const CaseNode& item : node.items) out += (out.empty() ? "" : ", ") + flow(item);
  for (const auto& [key, where, value] : node.entries)
    out += fmt::format("{}{}: {}", out.empty() ? "" : ", ", key_text(key), flow(value));
  return is_list ? fmt::format("[{}]", out) : fmt::format("{{{}}}", out);
}

void write_block(const CaseNode& map, int indent, std::string* out) {
  for (const auto& [key, where, value] : map.entries) {
    *out += fmt::format("{:{}}{}:", "", indent, key_text(key));
    if (value.kind == CaseNode::Kind::map && !value.entries.empty()) {
      *out += '\n';
      write_block(value, indent + 2, out);
    } else {
      *out += ' ' + flow(value) + '\n';
    }
  }
}

}  // namespace

const CaseNode::Entry* CaseNode::find_entry(std::string_view key) const {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

const CaseNode* CaseNode::find(std::string_view key) const {
  const Entry* entry = find_entry(key);
  return entry ? &entry->value : nullptr;
}

FileLocation place_of(const CaseNode& map, std::string_view key) {
  const CaseNode* node = &map;
  while (!key.empty()) {
    const std::string_view word = key.substr(0, key.find_first_of(".[]"));
    key.remove_prefix(std::min(word.size() + 1, key.size()));
    if (word.empty()) continue;  // between `]` and `.`
    const CaseNode* next = node->find(word);
    size_t index = 0;
    if (node->kind == CaseNode::Kind::list &&
        std::from_chars(word.data(), word.data() + word.size(), index).ec == std::errc() &&
        index < node->items.size())
      next = &node->items[index];
    if (!next) break;
    node = next;
  }
  return node->where;
}

std::string shown(std::string_view text) {
  constexpr size_t kLongest = 60;
  std::string out(text.substr(0, kLongest));
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text.size() > kLongest ? out + "..." : out;
}

std::string shown(const CaseNode& node) {
  switch (node.kind) {
    case CaseNode::Kind::empty:
      return "(empty)";
    case CaseNode::Kind::scalar:
      return node.quoted ? fmt::format("\"{}\"", shown(node.text)) : shown(node.text);
    case CaseNode::Kind::list:
      return "[...]";
    case CaseNode::Kind::map:
      return "{...}";
  }
  return {};
}

std::string to_yaml(const CaseNode& map) {
  std::string out;
  write_block(map, 0, &out);
  return out;
}

}  // namespace cupola
