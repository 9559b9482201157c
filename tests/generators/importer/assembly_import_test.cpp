// Assemblies of Cupola as blocks of a case.
#include "assembly/export/export.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "tests/generators/importer/import_files.hpp"

namespace cupola::import_test {
namespace {

Case arch_case() {
  Case scene;
  scene.geometry.surface = ArchSurface{};
  scene.geometry.bond = StackBond{.rings = 7, .blocks_per_ring = 1};
  return scene;
}

TEST_F(Import, TakesAnAssemblyAsItIs) {
  const Assembly built = generate(arch_case());
  const std::string path = (folder_ / "arch.vtu").string();
  write_assembly(path, built, "");
  Case scene;
  scene.title = built.title;
  scene.geometry.imported.emplace().path = path;
  GenerateReport report;
  const Assembly again = generate(scene, &report);
  EXPECT_EQ(content_hash(again), content_hash(built));
  EXPECT_EQ(report.model.num_joints, 8);
  EXPECT_FALSE(report.import);
  EXPECT_EQ(complaint(path), "");
}

TEST_F(Import, RefusesKeysThatAnAssemblyAnswers) {
  const std::string path = (folder_ / "arch.vtu").string();
  write_assembly(path, generate(arch_case()), "");
  Case scene;
  scene.geometry.imported.emplace().path = path;
  scene.geometry.imported->fixed_by = ImportedBlocks::SupportRule::lowest;
  try {
    generate(scene);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("geometry.import.fixed_by: has no effect"), std::string::npos)
        << error.what();
  }
}

// Files of Cupola and its COMPAS files give every block a density: a material could not change it.
TEST_F(Import, RefusesAMaterialThatNoBlockTakes) {
  const Assembly arch = generate(arch_case());
  for (const char* ending : {".vtu", ".json", ".obj"}) {
    const std::string path = (folder_ / "arch").string() + ending;
    write_export(path, {arch, {}, {}});
    Case scene;
    scene.geometry.imported.emplace().path = path;
    EXPECT_NO_THROW(generate(scene)) << path;
    scene.material.unit_weight = 25000.0;
    std::string message;
    try {
      generate(scene);
    } catch (const InputError& error) {
      message = error.what();
    }
    EXPECT_EQ(message.find("material: has no effect") != std::string::npos, std::string(ending) != ".obj")
        << path << ": " << message;
  }
}

}  // namespace
}  // namespace cupola::import_test
