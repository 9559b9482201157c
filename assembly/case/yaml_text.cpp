#include "assembly/case/yaml_text.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/null.h>
#include <yaml-cpp/parser.h>

namespace cupola {
namespace {

constexpr size_t kLargestFile = 1 << 20;  // bytes; a case has a few thousand
constexpr size_t kDeepestNesting = 32;    // a case has about five levels

FileLocation location(const std::string& file, const YAML::Mark& mark) {
  if (mark.is_null()) return {file, 0, 0};
  return {file, mark.line + 1, mark.column + 1};
}

/// Builds the tree from the events of the parser. Unlike the nodes of yaml-cpp, events reveal duplicate keys
/// and do not expand aliases.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  CaseNode root;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
    CaseNode empty = node(CaseNode::Kind::empty, mark);
    empty.text = written_null(mark);
    add(std::move(empty));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { refuse_anchor(mark); }
  void OnAnchor(const YAML::Mark& mark, const std::string&) override { refuse_anchor(mark); }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                const std::string& value) override {
    if (tag != "?" && tag != "!" && !tag.empty()) refuse_tag(mark, tag);
    CaseNode scalar = node(CaseNode::Kind::scalar, mark);
    scalar.text = value;
    scalar.quoted = tag == "!";
    if (value.find('\0') != std::string::npos)
      throw InputError(scalar.where, "text must not contain a NUL character");
    add(std::move(scalar));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(CaseNode::Kind::list, mark, tag);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    open(CaseNode::Kind::map, mark, tag);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    CaseNode node;
    bool has_key = false;  // for a map: the key is read, its value follows
    std::string key;
    FileLocation key_where;
  };

  /// The word at the mark if it stands for nothing. Of a missing value, yaml-cpp marks what comes next.
  std::string written_null(const YAML::Mark& mark) const {
    const size_t start = std::min(static_cast<size_t>(mark.pos), text_.size());
    const size_t end = std::min(text_.find_first_of(" \t\r\n,]}:", start), text_.size());
    const std::string word = text_.substr(start, end - start);
    return YAML::IsNullString(word) ? word : "";
  }

  CaseNode node(CaseNode::Kind kind, const YAML::Mark& mark) const {
    CaseNode result;
    result.kind = kind;
    result.where = location(file_, mark);
    return result;
  }

  [[noreturn]] void refuse_anchor(const YAML::Mark& mark) const {
    throw InputError(location(file_, mark), "anchors (&) and aliases (*) are not allowed; use `extends`");
  }
  [[noreturn]] void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    throw InputError(location(file_, mark), fmt::format("the tag {} is not allowed; remove it", shown(tag)));
  }

  void open(CaseNode::Kind kind, const YAML::Mark& mark, const std::string& tag) {
    if (tag != "?" && tag != "!" && !tag.empty()) refuse_tag(mark, tag);
    if (levels_.size() >= kDeepestNesting)
      throw InputError(location(file_, mark), fmt::format("nested deeper than {} levels", kDeepestNesting));
    if (!levels_.empty() && is_waiting_for_key()) refuse_key(location(file_, mark));
    levels_.push_back({node(kind, mark), false, {}, {}});
  }

  void close() {
    CaseNode done = std::move(levels_.back().node);
    levels_.pop_back();
    add(std::move(done));
  }

  bool is_waiting_for_key() const {
    return levels_.back().node.kind == CaseNode::Kind::map && !levels_.back().has_key;
  }
  [[noreturn]] static void refuse_key(const FileLocation& where) {
    throw InputError(where, "a key must be a name, not a list or a map");
  }

  void add(CaseNode value) {
    if (levels_.empty()) {
      root = std::move(value);
      return;
    }
    Level& level = levels_.back();
    if (level.node.kind == CaseNode::Kind::list) {
      level.node.items.push_back(std::move(value));
    } else if (!level.has_key) {
      if (value.kind != CaseNode::Kind::scalar) refuse_key(value.where);
      if (const CaseNode::Entry* first = level.node.find_entry(value.text))
        throw InputError(value.where, fmt::format("the key {} is given twice, first on line {}",
                                                  shown(value.text), first->where.line));
      level.key = value.text;
      level.key_where = value.where;
      level.has_key = true;
    } else {
      if (value.kind == CaseNode::Kind::empty) value.where = level.key_where;  // yaml-cpp marks the next line
      level.node.entries.push_back({std::move(level.key), level.key_where, std::move(value)});
      level.has_key = false;
    }
  }

  const std::string& text_;
  const std::string& file_;
  std::vector<Level> levels_;
};

/// Length of the UTF-8 sequence that starts at `i`, or 0 if it is invalid (RFC 3629).
size_t utf8_length(const std::string& text, size_t i) {
  const auto byte = [&](size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : static_cast<unsigned char>(0);
  };
  const unsigned first = byte(i);
  if (first < 0x80) return 1;
  const size_t length = first >= 0xC2 && first < 0xE0   ? 2
                        : first >= 0xE0 && first < 0xF0 ? 3
                        : first >= 0xF0 && first < 0xF5 ? 4
                                                        : 0;
  for (size_t k = 1; k < length; ++k)
    if ((byte(i + k) & 0xC0) != 0x80) return 0;
  const bool overlong_or_surrogate =
      (first == 0xE0 && byte(i + 1) < 0xA0) || (first == 0xED && byte(i + 1) > 0x9F) ||
      (first == 0xF0 && byte(i + 1) < 0x90) || (first == 0xF4 && byte(i + 1) > 0x8F);
  return overlong_or_surrogate ? 0 : length;
}

void check_characters(const std::string& text, const std::string& file) {
  if (text.size() > kLargestFile)
    throw InputError(FileLocation{file},
                     fmt::format("larger than {} bytes, the limit for a case file", kLargestFile));
  FileLocation where{file, 1, 1};
  bool indenting = true;
  for (size_t i = 0; i < text.size();) {
    const char c = text[i];
    const size_t length = utf8_length(text, i);
    if (length == 0) throw InputError(where, "not UTF-8 text; save the file with UTF-8 encoding");
    if (indenting && c == '\t') throw InputError(where, "the line is indented with a tab; use spaces");
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t') || c == 0x7f)
      throw InputError(where, fmt::format("control character {:#04x} is not allowed", c));
    indenting = c == '\n' || (indenting && c == ' ');
    if (c == '\n') {
      ++where.line;
      where.column = 0;
    }
    ++where.column;
    i += length;
  }
}

}  // namespace

CaseNode parse_yaml(const std::string& text, const std::string& file) {
  check_characters(text, file);
  std::istringstream stream(text);
  TreeBuilder builder(text, file);
  TreeBuilder second(text, file);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) throw InputError(FileLocation{file}, "is empty");
    if (parser.HandleNextDocument(second))
      throw InputError(second.root.where, "a second YAML document starts here; a case file holds only one");
  } catch (const YAML::Exception& error) {
    throw InputError(location(file, error.mark), "not valid YAML: " + error.msg);
  }
  return std::move(builder.root);
}

}  // namespace cupola
