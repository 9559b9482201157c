// cupola-generate: cuts the vault of a case into rigid blocks, or imports blocks, and checks them.
//
// Sample runs:
//   cupola-generate cases/dome_circular.yaml --output assembly.vtu
//   cupola-generate cases/dome_circular.yaml --output assembly.vtu --export dome.gltf
//   cupola-generate cases/dome_circular.yaml --output thin.vtu --set geometry.surface.thickness=1.1

#include <filesystem>

#include <fmt/format.h>

#include "assembly/export/export.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/program/command_line.hpp"
#include "assembly/program/warnings.hpp"
#include "generators/generate.hpp"
#include "generators/generate_report.hpp"
#include "generators/stereotomy/bond_map.hpp"

namespace {

using namespace cupola;

void make_parent(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  if (!folder.empty()) make_folder(folder.string());
  remove_part_files(folder.string());
}

ExitCode generate_assembly(int argc, char** argv) {
  // 1. Read the command line
  std::string output, export_file, report_file, bond_map_file, contacts_file;
  CommandLine line("cupola-generate", "Cuts the vault of a case into rigid blocks and checks them.",
                   "  cupola-generate dome.yaml --output assembly.vtu\n"
                   "  cupola-generate dome.yaml --output thin.vtu --set geometry.surface.thickness=1.1");
  line.required("--output", &output, "FILE", "assembly to write (.vtu)");
  line.optional("--export", &export_file, "FILE",
                std::string("the blocks for another program: ") + kExportFormats);
  line.optional("--report", &report_file, "FILE", "stereotomy report to write (.json for JSON, else text)");
  line.optional("--bond-map", &bond_map_file, "FILE", "drawing of the unrolled bond to write (.svg)");
  line.optional(
      "--contacts", &contacts_file, "FILE",
      "contact points to write from the interfaces of an imported file (.csv, for contact.method: file)");
  if (const auto ended = line.parse(argc, argv)) return *ended;

  if (!export_file.empty()) check_export_path(export_file);
  for (const std::string& file : {output, export_file, report_file, bond_map_file, contacts_file})
    check_output_file(file);

  // 2. Read the case
  const Case scene = line.read_case();
  if (line.check_only()) return line.report_warnings(scene.warnings), ExitCode::done;

  // 3. Generate and check the blocks
  GenerateReport report;
  const Assembly assembly = generate(scene, &report);
  if (!line.quiet()) fmt::print("{}", to_text(report));
  line.report_warnings(united({assembly.case_warnings, assembly.block_warnings}));

  // 4. Write the files
  make_parent(output);
  write_assembly(output, assembly, scene.effective_yaml);
  if (!export_file.empty()) write_export(export_file, {assembly, {}, {}});
  if (!report_file.empty()) {
    make_parent(report_file);
    write_text_atomically(report_file, report_file.ends_with(".json") ? report_json(assembly, report)
                                                                      : report_text(assembly, report));
  }
  if (!bond_map_file.empty()) {
    make_parent(bond_map_file);
    write_text_atomically(bond_map_file, bond_map_svg(scene.geometry));
  }
  if (!contacts_file.empty()) {
    if (!scene.geometry.imported)
      throw InputError(
          "--contacts: requires an imported COMPAS assembly, generated blocks have no interfaces");
    make_parent(contacts_file);
    write_text_atomically(contacts_file, contacts_csv(*scene.geometry.imported, assembly, *report.import));
  }
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("cupola-generate", [&] { return generate_assembly(argc, argv); });
}
