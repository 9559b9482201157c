// cupola-generate: cuts the vault of a case into rigid blocks, or imports blocks, and checks them.
//
// Sample runs:
//   cupola-generate cases/dome_circular.yaml --output assembly.vtu
//   cupola-generate cases/dome_circular.yaml --output assembly.vtu --export dome.gltf
//   cupola-generate cases/dome_circular.yaml --output thin.vtu --set geometry.surface.thickness=1.1

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/case/key_places.hpp"
#include "assembly/export/export.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/program/batch.hpp"
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

/// Files to write; only the first is required.
struct OutputFiles {
  std::string assembly, exported, report, bond_map, contacts;
};

/// What a case was cut into.
struct Blocks {
  std::shared_ptr<const Case> scene;
  Assembly assembly;
  GenerateReport report;
};

ExitCode write_files(const OutputFiles& files, const Case& scene, const Assembly& assembly,
                     const GenerateReport& report) {
  make_parent(files.assembly);
  write_assembly(files.assembly, assembly, scene.effective_yaml);
  if (!files.exported.empty()) write_export(files.exported, {assembly, {}, {}});
  if (!files.report.empty()) {
    make_parent(files.report);
    write_text_atomically(files.report, files.report.ends_with(".json") ? report_json(assembly, report)
                                                                        : report_text(assembly, report));
  }
  if (!files.bond_map.empty()) {
    make_parent(files.bond_map);
    write_text_atomically(files.bond_map, bond_map_svg(scene.geometry));
  }
  if (!files.contacts.empty()) {
    if (!report.import)
      throw InputError(
          "--contacts: requires an imported COMPAS assembly, generated blocks have no interfaces");
    make_parent(files.contacts);
    write_text_atomically(files.contacts, contacts_csv(*scene.geometry.imported, assembly, *report.import));
  }
  return ExitCode::done;
}

PreparedRun prepare(int argc, char** argv) {
  // 1. Read the command line
  OutputFiles files;
  auto line = std::make_shared<CommandLine>(
      "cupola-generate", "Cuts the vault of a case into rigid blocks and checks them.",
      "  cupola-generate dome.yaml --output assembly.vtu\n"
      "  cupola-generate dome.yaml --output thin.vtu --set geometry.surface.thickness=1.1");
  line->required("--output", &files.assembly, "FILE", "assembly to write (.vtu)");
  line->optional("--export", &files.exported, "FILE",
                 std::string("the blocks for another program: ") + kExportFormats);
  line->optional("--report", &files.report, "FILE", "stereotomy report to write (.json for JSON, else text)");
  line->optional("--bond-map", &files.bond_map, "FILE", "drawing of the unrolled bond to write (.svg)");
  line->optional(
      "--contacts", &files.contacts, "FILE",
      "contact points to write from the interfaces of an imported file (.csv, for contact.method: file)");
  if (const auto ended = line->parse(argc, argv)) return [code = *ended] { return code; };

  if (!files.exported.empty()) check_export_path(files.exported);
  for (const std::string& file :
       {files.assembly, files.exported, files.report, files.bond_map, files.contacts})
    check_output_file(file);

  // 2. Read the case
  const auto scene = std::make_shared<const Case>(line->read_case());
  if (line->check_only()) {
    line->report_warnings(scene->warnings);
    return [] { return ExitCode::done; };
  }

  // 3. Generate and check the blocks. The runs of a batch that have the same blocks cut them once.
  static std::shared_ptr<Blocks> last;
  if (!last || !have_same_blocks(*scene, *last->scene)) {
    auto blocks = std::make_shared<Blocks>(Blocks{scene, {}, {}});
    blocks->assembly = with_places_of_keys(*scene, [&] { return generate(*scene, &blocks->report); });
    last = std::move(blocks);
  }

  // 4. Write the files. The process is that of this run alone, which may take the blocks.
  return [line, scene, files, blocks = last] {
    const Assembly assembly = with_places_of_keys(
        *scene, [&] { return generate_again(*scene, std::move(blocks->assembly), blocks->report); });
    if (!line->quiet() && !scene->left_out.empty())
      fmt::print("inherited, but not keys of the new type: {}\n", fmt::join(scene->left_out, ", "));
    if (!line->quiet()) fmt::print("{}", to_text(blocks->report));
    std::vector<std::string> lost;
    if (!files.exported.empty()) lost = lost_by_export(files.exported, assembly);
    line->report_warnings(united({assembly.case_warnings, assembly.block_warnings, lost}));
    return write_files(files, *scene, assembly, blocks->report);
  };
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("cupola-generate", argc, argv, prepare);
}
