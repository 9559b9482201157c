#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/mesh_file.hpp"
#include "solver/collision/contact_detector.hpp"
#include "solver/collision/contact_file.hpp"
#include "solver/collision/patch_file.hpp"
#include "tests/solver/scenes.hpp"

namespace cupola::file_test {
namespace {

using namespace testing;  // the scenes

const std::string kHeader = "block_a,block_b,joint,x,y,z,nx,ny,nz,gap_m,area_m2\n";

/// Each test has its own folder, removed at its end.
class ContactFile : public ::testing::Test {
 protected:
  ContactFile()
      : folder_(std::filesystem::temp_directory_path() /
                (std::string("cupola_") + ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    make_folder(folder_.string());
  }
  ~ContactFile() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& text) const {
    write_text_atomically(path("contacts.csv"), text);
    return path("contacts.csv");
  }
  /// Message of the error thrown when the text is read.
  std::string error_message(const std::string& text) const {
    try {
      read_contacts(write(text), scene_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  Assembly scene_ = box_on_floor(Vec3(1, 1, 1));
  std::filesystem::path folder_;
};

TEST_F(ContactFile, HasItsColumnsInTheFormats) {
  const std::string page = read_text(CUPOLA_SOURCE_DIR "/assembly/FORMAT.md");
  const size_t start = page.find("## Contact points of another program\n");
  ASSERT_NE(start, std::string::npos);
  size_t at = start;
  std::istringstream header(kHeader.substr(0, kHeader.size() - 1));
  for (std::string column; std::getline(header, column, ',');) {
    at = page.find("`" + column + "`", at);
    EXPECT_LT(at, page.find("## results/", start)) << column << " is missing, or not in its place";
  }
}

TEST_F(ContactFile, ProvidesTheContactsItLists) {
  DetectionOptions options;
  options.contact_file = write(kHeader +
                               "0,1,0,-0.4,0,0,0,0,2,0.001,0.3\n"
                               "1,0,0,0.4,0,0,0,0,-1,0,0.7\n");  // blocks in the other order
  ContactDetector detector(scene_, options);
  auto poses = initial_poses(scene_);
  const ContactSet& set = detector.update(poses);
  ASSERT_EQ(set.points.size(), 2u);
  ASSERT_EQ(set.patches.size(), 1u);
  EXPECT_EQ(set.patches[0].kind, JointKind::base);
  EXPECT_NEAR(set.patches[0].area, 1.0, 1e-15);
  EXPECT_NEAR(set.points[0].gap, 0.001, 1e-15);
  for (const Contact& contact : set.points) {
    EXPECT_EQ(contact.block_a, 0);
    EXPECT_LT((contact.normal - Vec3::UnitZ()).norm(), 1e-15);
  }
  poses[1].p_WB.z() += 0.5;  // far beyond the margin: the same contacts are kept
  EXPECT_NEAR(detector.update(poses).points[1].gap, 0.5, 1e-15);
  EXPECT_EQ(detector.num_detections(), 1);
}

TEST_F(ContactFile, GivesJointsOnSupportsTheCourseOfTheirBlock) {
  scene_.blocks[1].ring = 3;
  DetectionOptions options;
  options.contact_file = write(kHeader + "0,1,0,0,0,0,0,0,1,0,1\n");
  EXPECT_EQ(ContactDetector(scene_, options).update(initial_poses(scene_)).patches.at(0).ring, 3);
}

TEST_F(ContactFile, ReproducesDetectedContacts) {
  const Assembly wall = running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 3);
  const ContactSet found = ContactDetector(wall, {}).update(initial_poses(wall));
  std::string text = kHeader;
  for (const Contact& c : found.points)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", c.block_a, c.block_b, c.patch, c.point_a.x(),
                        c.point_a.y(), c.point_a.z(), c.normal.x(), c.normal.y(), c.normal.z(), 0.0, c.area);
  DetectionOptions options;
  options.contact_file = write(text);
  const ContactSet given = ContactDetector(wall, options).update(initial_poses(wall));
  ASSERT_EQ(given.points.size(), found.points.size());
  ASSERT_EQ(given.patches.size(), found.patches.size());
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    EXPECT_EQ(given.points[i].block_b, found.points[i].block_b);
    EXPECT_LT((given.points[i].point_a - found.points[i].point_a).norm(), 1e-14);
    EXPECT_NEAR(given.patches[given.points[i].patch].area, found.patches[found.points[i].patch].area, 1e-12);
  }
}

TEST_F(ContactFile, ErrorsStateFileLineAndRule) {
  EXPECT_NE(error_message("a,b\n").find("contacts.csv:1:1: error: the first line must be block_a,"),
            std::string::npos);
  EXPECT_NE(error_message(kHeader).find("contains no contact"), std::string::npos);
  EXPECT_NE(error_message(kHeader + "0,1,0,0,0,0,0,0,1,0\n").find(":2:1: error: 10 of 11 columns"),
            std::string::npos);
  EXPECT_NE(error_message(kHeader + "0,1,0,0,0,0,0,0,1,0,1,1\n").find("more than 11"), std::string::npos);
  EXPECT_NE(
      error_message(kHeader + "0,7,0,0,0,0,0,0,1,0,1\n").find("block 7: must be an integer from 0 to 1"),
      std::string::npos);
  EXPECT_NE(error_message(kHeader + "0,nan,0,0,0,0,0,0,1,0,1\n").find("column 2"), std::string::npos);
  EXPECT_NE(error_message(kHeader + "1,1,0,0,0,0,0,0,1,0,1\n").find("block_a and block_b are both 1"),
            std::string::npos);
  EXPECT_NE(error_message(kHeader + "0,1,0,0,0,0,0,0,0,0,1\n").find("nx, ny, nz are all zero"),
            std::string::npos);
  EXPECT_NE(error_message(kHeader + "0,1,0,0,0,0,0,0,1,0,-1\n").find("area_m2 = -1: must be > 0"),
            std::string::npos);
}

// The block is a cube of 1 m on the plane z = 0; the margin is 0.01 m. What is no contact would carry forces.
TEST_F(ContactFile, RefusesPointsWhereTheBlocksDoNotTouch) {
  for (const auto& [row, phrase] :
       {std::pair("0,1,0,0,0,0,0,0,1,0.5,1\n", "gap_m = 0.5: blocks touch within contact.margin = 0.01 m"),
        {"0,1,0,0,0,0,0,0,1,-0.02,1\n", "gap_m = -0.02: blocks touch within"},
        {"0,1,0,0.62,0,0,0,0,1,0,1\n", "the point lies 0.12 m beyond the faces of block 1"},
        {"0,1,0,0,0,0,0,0,-1,0,1\n", "nx, ny, nz point from block_b to block_a"},
        {"1,0,0,0,0,0,0,0,1,0,1\n", "nx, ny, nz point from block_b to block_a"},
        {"0,1,0,0,0,0,0,0,1,0,100\n", "area_m2 = 100: the faces of block 1 have 6 m2 in all"},
        {"0,1,0.5,0,0,0,0,0,1,0,1\n", "joint 0.5: must be an integer"}}) {
    const std::string message = error_message(kHeader + row);
    EXPECT_NE(message.find(std::string(":2:1: error: ") + phrase), std::string::npos) << message;
  }
  for (const char* row : {"0,1,0,0.59,0.59,0,0,0,1,0.01,1\n", "1,0,-3,0.5,0.5,0.005,0,0,-1,0.01,1\n"})
    EXPECT_EQ(error_message(kHeader + row), "no error");
}

TEST_F(ContactFile, PatchesAreWrittenAsPolygons) {
  const Assembly wall = running_bond_wall(Vec3(1.2, 1.0, 0.3), 3, 3);
  const ContactSet set = ContactDetector(wall, {}).update(initial_poses(wall));
  write_patches(path("patches.vtp"), set, "hash");
  const Mesh mesh = read_mesh(path("patches.vtp"));
  ASSERT_EQ(mesh.num_cells(), static_cast<int>(set.patches.size()));
  const auto& area = mesh.array<double>(mesh.cell_data, "area_m2", 1);
  const auto& block_b = mesh.array<std::int32_t>(mesh.cell_data, "block_b", 1);
  for (std::size_t p = 0; p < set.patches.size(); ++p) {
    EXPECT_EQ(area[p], set.patches[p].area);
    EXPECT_EQ(block_b[p], set.patches[p].block_b);
  }
}

}  // namespace
}  // namespace cupola::file_test
