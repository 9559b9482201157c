#include "assembly/case/case_reader.hpp"

#include "assembly/case/case_tree.hpp"
#include "assembly/case/declare.hpp"
#include "assembly/files/hash.hpp"

namespace cupola {
namespace {

/// Hash of the sections for which `is_read` is true.
std::string hash_sections(const CaseNode& effective, bool (*is_read)(const std::string& name)) {
  CaseNode chosen;
  chosen.kind = CaseNode::Kind::map;
  for (const CaseNode::Entry& entry : effective.entries)
    if (is_read(entry.key)) chosen.entries.push_back(entry);
  return hash_text(to_yaml(chosen));
}

/// Changes of other sections, for example friction or loads, leave the assembly valid.
bool generator_reads(const std::string& name) {
  return name == "geometry" || name == "material" || name == "imperfections";
}

/// Changes of the other sections leave the results valid.
bool solver_reads(const std::string& name) {
  return name != "title" && name != "postproc" && name != "sweep";
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
  the_case.hash = hash_sections(root.effective(), solver_reads);
  the_case.geometry_hash = hash_sections(root.effective(), generator_reads);
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
