#include "assembly/case/case_tree.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "assembly/case/bundled.hpp"
#include "assembly/case/yaml_text.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/number_text.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

constexpr size_t kLongestChain = 16;  // of files that extend one another

/// Unique absolute name of a file, which need not exist; weakly_canonical alone leaves some names relative.
fs::path identity_of(const fs::path& path) {
  return fs::weakly_canonical(fs::absolute(path));
}

/// Maps in which the `type` decides which other keys exist. The keys of `analysis` are common to all types.
bool type_owns_keys(const std::string& path) {
  constexpr std::array kMaps{".surface", ".plan", ".profile", ".bond"};
  return path.starts_with("geometry.") &&
         std::ranges::any_of(kMaps, [&](const char* map) { return path.ends_with(map); });
}

/// The item that `key` names, as `wythes[0]`, in a list of `map`; nullptr: the key names no item of a list.
CaseNode* find_item(CaseNode* map, const CaseNode::Entry& key) {
  const size_t bracket = key.key.find('[');
  if (bracket == std::string::npos || !key.key.ends_with(']')) return nullptr;
  const auto list = std::ranges::find(map->entries, key.key.substr(0, bracket), &CaseNode::Entry::key);
  if (list == map->entries.end() || list->value.kind != CaseNode::Kind::list) return nullptr;
  std::vector<CaseNode>& items = list->value.items;
  int index = 0;
  const std::string number = key.key.substr(bracket + 1, key.key.size() - bracket - 2);
  if (!read_integer(number, &index).empty() || index < 0 || index >= static_cast<int>(items.size()))
    throw InputError(key.where, fmt::format("{}: {} has {} items, numbered from 0", shown(key.key), list->key,
                                            items.size()));
  return &items[static_cast<size_t>(index)];
}

/// Merges `over` into `base`: maps key by key, other nodes replace. In a map whose keys depend on its type,
/// those under a different type stay, marked: only the reader knows which of them the new type has. The key
/// `name[i]` changes item i of a list.
void overlay(CaseNode* base, const CaseNode& over, const std::string& path = "") {
  if (base->kind != CaseNode::Kind::map || over.kind != CaseNode::Kind::map) {
    *base = over;
    return;
  }
  const CaseNode* old_type = base->find("type");
  const CaseNode* new_type = over.find("type");
  if (type_owns_keys(path) && old_type && new_type && old_type->text != new_type->text)
    for (CaseNode::Entry& entry : base->entries) entry.value.of_other_type = true;
  base->of_other_type = false;
  for (const CaseNode::Entry& entry : over.entries) {
    const std::string entry_path = path.empty() ? entry.key : path + "." + entry.key;
    if (CaseNode* item = find_item(base, entry)) {
      overlay(item, entry.value, entry_path);
      continue;
    }
    const auto present = std::find_if(base->entries.begin(), base->entries.end(),
                                      [&](const CaseNode::Entry& e) { return e.key == entry.key; });
    if (present == base->entries.end()) {
      base->entries.push_back(entry);
      continue;
    }
    if (present->value.of_other_type) present->where = entry.where;  // the new type may not have it
    overlay(&present->value, entry.value, entry_path);
  }
}

/// Removes the keys that are `null`, of the case or by what extends it. Those without a value stay, as errors.
void remove_nulls(CaseNode* node) {
  std::erase_if(node->entries, [](const CaseNode::Entry& entry) {
    return entry.value.kind == CaseNode::Kind::empty && !entry.value.text.empty();
  });
  for (CaseNode::Entry& entry : node->entries) remove_nulls(&entry.value);
  for (CaseNode& item : node->items) remove_nulls(&item);
}

/// `cupola:NAME` if a file of this name comes with Cupola, else "".
std::string bundled_name(const std::string& file) {
  const std::string folder = bundled_folder();
  const fs::path name = fs::path(file).filename();
  std::error_code error;
  const bool comes_with_cupola =
      !folder.empty() && name.extension() == ".yaml" && fs::is_regular_file(fs::path(folder) / name, error);
  return comes_with_cupola ? kBundledPrefix + name.stem().string() : "";
}

/// Files read so far.
struct ExtendsChain {
  std::vector<fs::path> identities;
  std::vector<std::string> paths;
  std::vector<std::string> warnings;
};

/// Takes from a case what the one that extends it does not inherit.
void disinherit(const CaseNode& tree, const std::string& path, const std::string& base_name, CaseNode* base,
                ExtendsChain* chain) {
  for (const char* key : {"sweep", "ensemble"}) {
    if (!base->find(key) || tree.find(key)) continue;
    std::erase_if(base->entries, [&](const CaseNode::Entry& entry) { return entry.key == key; });
    chain->warnings.push_back(
        fmt::format("{} extends {}, but not its {}: this is one run; to run its members, repeat the {} here",
                    fs::path(path).filename().string(), base_name, key, key));
  }
}

CaseNode load_file(const std::string& path, const std::string& root_folder, ExtendsChain* chain) {
  chain->paths.push_back(path);
  CaseNode tree = parse_yaml(read_text(path), path);
  if (tree.kind != CaseNode::Kind::map)
    throw InputError(tree.where, "a case file is a map of sections, `key: value`");

  const CaseNode::Entry* extends = tree.find_entry("extends");
  if (!extends) return tree;
  const CaseNode& name = extends->value;
  if (name.kind != CaseNode::Kind::scalar || name.text.empty())
    throw InputError(name.where, fmt::format("extends = {}: must be the name of a case file", shown(name)));
  const bool bundled = name.text.starts_with(kBundledPrefix);
  const std::string base_path =
      bundled ? bundled_case(name.text, name.where) : path_inside(root_folder, path, name.text, name.where);
  chain->identities.push_back(identity_of(path));
  if (std::ranges::find(chain->identities, identity_of(base_path)) != chain->identities.end())
    throw InputError(
        name.where,
        fmt::format("extends = {}: the files extend one another in a circle; remove one of the extends keys",
                    shown(name)));
  if (chain->identities.size() >= kLongestChain)
    throw InputError(name.where, fmt::format("extends = {}: more than {} files extend one another",
                                             shown(name), kLongestChain));
  if (!fs::is_regular_file(base_path)) {
    const std::string meant = bundled_name(name.text);
    throw InputError(name.where, fmt::format("extends = {}: no such file{}", shown(name),
                                             meant.empty() ? "" : fmt::format("; did you mean {}?", meant)));
  }

  tree.entries.erase(tree.entries.begin() + (extends - tree.entries.data()));
  CaseNode merged = load_file(base_path, bundled ? bundled_folder() : root_folder, chain);
  disinherit(tree, path, fs::path(base_path).filename().string(), &merged, chain);
  overlay(&merged, tree);
  return merged;
}

/// Converts `joints.friction=0.3` to the tree {joints: {friction: 0.3}}. The position of every node is the
/// option.
CaseNode parse_set_option(const std::string& option) {
  const std::string file = "--set " + shown(option);
  const size_t equals = option.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(FileLocation{file}, "must be key.path=value, for example joints.friction=0.3");
  const std::string value = option.substr(equals + 1);
  CaseNode tree = value.empty() ? CaseNode{} : parse_yaml(value, file);
  const auto locate = [&file](auto& self, CaseNode& node) -> void {
    node.where = {file};
    for (CaseNode& item : node.items) self(self, item);
    for (CaseNode::Entry& entry : node.entries) {
      entry.where = {file};
      self(self, entry.value);
    }
  };
  locate(locate, tree);
  const std::string path = option.substr(0, equals);
  for (size_t end = path.size();;) {
    const size_t dot = path.rfind('.', end - 1);
    const size_t start = dot == std::string::npos ? 0 : dot + 1;
    if (start >= end)
      throw InputError(FileLocation{file}, "the key path has an empty part; write key.path=value");
    CaseNode parent;
    parent.kind = CaseNode::Kind::map;
    parent.where = {file};
    parent.entries.push_back({path.substr(start, end - start), {file}, std::move(tree)});
    tree = std::move(parent);
    if (start == 0) return tree;
    end = dot;
    if (end == 0)
      throw InputError(FileLocation{file}, "the key path has an empty part; write key.path=value");
  }
}

}  // namespace

std::string path_inside(const std::string& root_folder, const std::string& from_file, const std::string& name,
                        const FileLocation& where) {
  if (name.empty()) throw InputError(where, "must name a file, and is empty");
  const fs::path path = fs::path(from_file).parent_path() / name;
  std::error_code error;
  if (fs::status(path, error).type() == fs::file_type::none)  // too long, circular links, no permission
    throw InputError(where, fmt::format("{}: cannot be accessed: {}", shown(name), error.message()));
  const fs::path root = identity_of(root_folder.empty() ? "." : root_folder);
  const fs::path relative = identity_of(path).lexically_relative(root);
  if (fs::path(name).is_absolute() || relative.empty() || *relative.begin() == "..") {
    const std::string bundled = bundled_name(name);
    throw InputError(where,
                     fmt::format("{}: the file must lie in or below the folder of the case; copy it there{}",
                                 shown(name), bundled.empty() ? "" : fmt::format(", or write {}", bundled)));
  }
  return path.string();
}

CaseNode load_case_tree(const std::string& path, const std::vector<std::string>& set_options,
                        std::vector<std::string>* files, std::vector<std::string>* warnings) {
  ExtendsChain chain;
  CaseNode tree = load_file(path, fs::path(path).parent_path().string(), &chain);
  // The options are merged into one tree first, so that their order does not matter if one changes a type.
  CaseNode options;
  options.kind = CaseNode::Kind::map;
  for (const std::string& option : set_options) overlay(&options, parse_set_option(option));
  overlay(&tree, options);
  remove_nulls(&tree);
  if (files) *files = chain.paths;
  if (warnings) *warnings = chain.warnings;
  return tree;
}

}  // namespace cupola
