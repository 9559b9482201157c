#include "assembly/case/case_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "assembly/case/case_times.hpp"
#include "assembly/case/case_tree.hpp"
#include "assembly/case/declare.hpp"
#include "assembly/case/plausibility.hpp"
#include "assembly/case/suggestion.hpp"
#include "assembly/files/hash.hpp"

namespace cupola {
namespace {

/// Hash of the sections for which `is_read` is true, and of the contents of the files that they name: a file
/// that changes without its name is another case.
std::string hash_sections(const CaseNode& tree, const std::vector<NamedFile>& files,
                          bool (*is_read)(const std::string& name)) {
  CaseNode chosen;
  chosen.kind = CaseNode::Kind::map;
  for (const CaseNode::Entry& entry : tree.entries)
    if (is_read(entry.key)) chosen.entries.push_back(entry);
  std::string text = to_yaml(chosen);
  for (const NamedFile& file : files)
    if (is_read(file.key.substr(0, file.key.find_first_of(".["))))
      text += fmt::format("# {}: {}\n", std::filesystem::path(file.path).filename().string(),
                          hash_file(file.path));
  return hash_text(text);
}

/// Changes of other sections, for example friction or loads, leave the assembly valid.
bool generator_reads(const std::string& name) {
  return name == "geometry" || name == "material" || name == "imperfections";
}

/// Changes of the other sections leave the results valid.
bool solver_reads(const std::string& name) {
  return name != "title" && name != "postproc" && name != "sweep" && name != "ensemble";
}

/// What lists the members changes none of them.
bool a_member_reads(const std::string& name) {
  return name != "sweep" && name != "ensemble";
}

/// The title, followed by the options that change the model: `Dome (with joints.friction=0.3)`.
std::string title_with(const std::string& title, const std::vector<std::string>& set_options) {
  std::vector<std::string> changes;
  for (const std::string& option : set_options) {
    const std::string section = option.substr(0, option.find_first_of(".="));
    if (solver_reads(section) && section != "output") changes.push_back(option);
  }
  return changes.empty() ? title : fmt::format("{} (with {})", title, fmt::join(changes, ", "));
}

/// Removes the keys that a map of another `type` left and that are not in force, and lists their paths.
void leave_out_keys_of_other_types(const CaseNode& effective, const std::string& path, CaseNode* node,
                                   std::vector<std::string>* left_out) {
  for (size_t i = 0; i < std::min(node->items.size(), effective.items.size()); ++i)
    leave_out_keys_of_other_types(effective.items[i], fmt::format("{}[{}]", path, i), &node->items[i],
                                  left_out);
  std::erase_if(node->entries, [&](CaseNode::Entry& entry) {
    const CaseNode* in_force = effective.find(entry.key);
    const std::string key = path.empty() ? entry.key : path + "." + entry.key;
    if (in_force) leave_out_keys_of_other_types(*in_force, key, &entry.value, left_out);
    const bool leave_out = !in_force && entry.value.of_other_type;
    if (leave_out) left_out->push_back(key);
    return leave_out;
  });
}

/// Reads a case without checking the members of its sweep.
Case read_one_case(const std::string& path, const std::vector<std::string>& set_options,
                   std::string* inputs_hash = nullptr) {
  Case the_case;
  std::vector<std::string> not_inherited;
  const auto keys =
      std::make_shared<CaseNode>(load_case_tree(path, set_options, &the_case.inputs, &not_inherited));
  the_case.keys = keys;
  Section root(keys.get(), "", keys->where, path);
  std::vector<NamedFile> files;
  root.collect_files(&files);
  std::vector<PlausibleRange> expected;
  root.collect_expected(&expected);
  declare_case(root, the_case);
  root.finish();
  leave_out_keys_of_other_types(root.effective(), "", keys.get(), &the_case.left_out);

  the_case.title = title_with(the_case.title, set_options);
  the_case.file = path;
  the_case.effective_yaml = to_yaml(root.effective());
  for (const NamedFile& file : files) the_case.inputs.push_back(file.path);
  if (inputs_hash) *inputs_hash = hash_sections(*the_case.keys, files, a_member_reads);
  the_case.hash = hash_sections(root.effective(), files, solver_reads);
  the_case.geometry_hash = hash_sections(root.effective(), files, generator_reads);
  the_case.warnings = sentences(expected);
  the_case.warnings.insert(the_case.warnings.begin(), not_inherited.begin(), not_inherited.end());
  for (std::string& unused : unused_tensions(the_case.joints)) the_case.warnings.push_back(std::move(unused));
  for (std::string& coarse : undivided_joints(the_case)) the_case.warnings.push_back(std::move(coarse));
  for (std::string& unused : unused_times(the_case)) the_case.warnings.push_back(std::move(unused));
  for (std::string& missed : missed_changes(the_case)) the_case.warnings.push_back(std::move(missed));
  return the_case;
}

/// Reads the case with one member's settings; `source` names the section that gives them.
void check_member(const std::string& path, const FileLocation& where, const std::string& source,
                  const std::vector<std::string>& settings) {
  try {
    read_one_case(path, settings);
  } catch (const InputError& error) {
    throw InputError(where, fmt::format("{}: {}", source, error.what()));
  }
}

}  // namespace

void check_samples(const std::string& path, const std::vector<std::string>& settings, const char* source,
                   const Samples& samples) {
  std::set<size_t> checked;  // rows
  for (size_t k = 0; k < samples.keys.size(); ++k) {
    // Admissible numbers form an interval, so that the least and the greatest stand for all.
    std::map<double, size_t> numbers;
    std::map<std::string, size_t> texts;
    for (size_t i = 0; i < samples.rows.size(); ++i)
      if (double value = 0.0; read_number(samples.rows[i][k], &value).empty())
        numbers.emplace(value, i);
      else
        texts.emplace(samples.rows[i][k], i);
    if (!numbers.empty()) checked.insert({numbers.begin()->second, numbers.rbegin()->second});
    for (const auto& [text, row] : texts) checked.insert(row);
  }
  const std::vector<SweepMember> members = members_of(samples, "");
  for (const size_t row : checked) {
    std::vector<std::string> all = settings;
    all.insert(all.end(), members[row].settings.begin(), members[row].settings.end());
    const FileLocation where = samples.places.empty() ? FileLocation{path} : samples.places[row];
    check_member(path, where, fmt::format("{}: member {}", source, members[row].name), all);
  }
}

Case read_case(const std::string& path, const std::vector<std::string>& set_options) {
  Case the_case = read_one_case(path, set_options);
  if (!set_options.empty()) {  // one member, which does not read the others
    std::erase(the_case.inputs, the_case.sample_file.file);
    return the_case;
  }
  for (size_t i = 0; i < the_case.sweep.size(); ++i)
    for (const std::string& value : the_case.sweep[i].values)
      check_member(path, place_of(*the_case.keys, fmt::format("sweep[{}].key", i)), "sweep",
                   {fmt::format("{}={}", the_case.sweep[i].key, value)});
  if (!the_case.sample_file.file.empty())
    check_samples(path, {}, "sweep", read_samples(the_case.sample_file.file));
  if (the_case.ensemble) check_samples(path, {}, "ensemble", draw_samples(*the_case.ensemble));
  return the_case;
}

std::string hash_of_inputs(const std::string& path, const std::vector<std::string>& set_options) {
  std::string hash;
  read_one_case(path, set_options, &hash);
  return hash;
}

SchemaTable case_schema_table() {
  SchemaTable table;
  Section root(&table, "");
  Case defaults;
  declare_case(root, defaults);
  return table;
}

std::string case_schema(const std::string& key) {
  const SchemaTable all = case_schema_table();
  SchemaTable chosen;
  std::vector<std::string> paths;
  for (const SchemaRow& row : all.rows) {
    const std::string& path = row.path;
    paths.push_back(path);
    const bool below = path.starts_with(key) && path.size() > key.size() &&
                       (path[key.size()] == '.' || path[key.size()] == '[');
    if (key.empty() || path == key || below) chosen.rows.push_back(row);
  }
  if (!chosen.rows.empty()) return to_text(chosen);
  const std::string near = nearest_name(key, paths);
  const std::string elsewhere = key.find('.') == std::string::npos ? suggestion_for({}, key, key) : "";
  throw InputError(fmt::format("--schema {}: no such key{}", key,
                               !elsewhere.empty() ? elsewhere
                               : near.empty()     ? "; --schema alone prints all"
                                                  : fmt::format("; did you mean {}?", near)));
}

std::string case_json_schema() {
  return to_json_schema(case_schema_table());
}

}  // namespace cupola
