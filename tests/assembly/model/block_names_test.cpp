#include "assembly/model/block_names.hpp"

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "tests/assembly/scene.hpp"

namespace cupola::block_names_test {
namespace {

Assembly named_blocks() {
  Assembly assembly = test::two_block_assembly();
  assembly.blocks[0].name = "the ground";
  assembly.blocks[1].name = "b5_2";
  return assembly;
}

std::string complaint(const Assembly& assembly, const char* name) {
  Loads loads;
  Ties ties;
  Supports supports;
  loads.forces.push_back({BlockRef(std::string(name)), {}, Vec3::Zero(), {}});
  try {
    resolve_block_names(assembly, &loads, &ties, &supports);
  } catch (const InputError& error) {
    return error.what();
  }
  return std::to_string(loads.forces[0].block);
}

TEST(BlockNames, AreResolvedToNumbers) {
  EXPECT_EQ(complaint(named_blocks(), "b5_2"), "1");
  EXPECT_EQ(complaint(named_blocks(), "the ground"), "0");
  EXPECT_EQ(complaint(named_blocks(), "b5_3"),
            "error: loads.forces[0].block: no block is named 'b5_3'; did you mean 'b5_2'?");
  EXPECT_EQ(
      complaint(named_blocks(), "something else"),
      "error: loads.forces[0].block: no block is named 'something else'; the first block is 'the ground'");
  EXPECT_EQ(
      complaint(test::two_block_assembly(), "b5_2"),
      "error: loads.forces[0].block: no block is named 'b5_2'; generated blocks have numbers, and supports "
      "the names "
      "'support 0', 'support 1', ...");
}

TEST(BlockNames, SupportsHaveNamesInTheirOrder) {
  Assembly assembly = test::two_block_assembly();
  for (Block& block : assembly.blocks) block.fixed = true;
  EXPECT_EQ(complaint(assembly, "support 1"), "1");
  assembly.blocks[0].fixed = false;
  EXPECT_EQ(complaint(assembly, "support 0"), "1");
}

TEST(BlockNames, AreKeptInTheAssemblyFile) {
  const Assembly assembly = named_blocks();
  const std::string path = test::fresh_folder("names") + "/assembly.vtu";
  write_assembly(path, assembly);
  const Assembly read = read_assembly(path);
  EXPECT_EQ(read.blocks[0].name, "the ground");
  EXPECT_EQ(block_label(read, 1), "b5_2");
  EXPECT_EQ(block_label(test::two_block_assembly(), 1), "1");
  EXPECT_NE(content_hash(assembly), content_hash(test::two_block_assembly()))
      << "a load may depend on a name";
}

// A limit of the thickness thins the blocks about a load.
TEST(BlockNames, APointChoosesItsBlockInTheBlocksAsBuilt) {
  Assembly assembly = test::two_block_assembly();
  Loads loads;
  Ties ties;
  Supports supports;
  BlockForce at_point;
  at_point.block = BlockForce::kAtPoint;
  at_point.point = assembly.blocks[1].centroid;
  loads.forces = {at_point};
  resolve_block_names(assembly, &loads, &ties, &supports);
  EXPECT_EQ(loads.forces[0].block, 1);
  loads.forces[0].block = BlockForce::kAtPoint;
  loads.forces[0].point = Vec3(0, 0, 100);
  EXPECT_THROW(resolve_block_names(assembly, &loads, &ties, &supports), InputError);
}

}  // namespace
}  // namespace cupola::block_names_test
