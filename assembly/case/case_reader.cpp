#include "assembly/case/case_reader.hpp"

#include "assembly/case/case_tree.hpp"
#include "assembly/case/declare.hpp"
#include "assembly/hash.hpp"

namespace cupola {
namespace {

/// Fingerprint of the sections that the generator reads: another friction or load keeps the assembly.
std::string hash_sections(const CaseNode& effective, std::initializer_list<std::string_view> names) {
  CaseNode chosen;
  chosen.kind = CaseNode::Kind::map;
  for (const std::string_view name : names)
    if (const CaseNode::Entry* entry = effective.find_entry(name)) chosen.entries.push_back(*entry);
  return hash_text(to_yaml(chosen));
}

}  // namespace

Case read_case(const std::string& path, const std::vector<std::string>& set_options) {
  const CaseNode tree = load_case_tree(path, set_options);
  Case the_case;
  Section root(&tree, "", tree.where, path);
  declare_case(root, the_case);
  root.finish();

  the_case.file = path;
  the_case.effective_yaml = to_yaml(root.effective());
  the_case.hash = hash_text(the_case.effective_yaml);
  the_case.geometry_hash = hash_sections(root.effective(), {"geometry", "material", "imperfections"});
  return the_case;
}

std::string case_schema() {
  SchemaTable table;
  Section root(&table, "");
  Case defaults;
  declare_case(root, defaults);
  return to_markdown(table);
}

}  // namespace cupola
