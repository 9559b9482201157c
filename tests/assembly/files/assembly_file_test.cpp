#include "assembly/files/assembly_file.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/files/mesh_file.hpp"
#include "tests/assembly/scene.hpp"

namespace cupola::assembly_file_test {
namespace {

std::string read_error(const std::string& path) {
  try {
    read_assembly(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(AssemblyFile, RoundTripsExactly) {
  const Assembly a = test::two_block_assembly();
  const std::string path = test::fresh_folder("a") + "/assembly.vtu";
  write_assembly(path, a);
  const Assembly b = read_assembly(path);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.face_vertex_start, b.face_vertex_start);
  EXPECT_EQ(a.face_vertices, b.face_vertices);
  EXPECT_EQ(a.face_kinds, b.face_kinds);
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.geometry_hash, b.geometry_hash);
  EXPECT_EQ(a.check_report, b.check_report);
  EXPECT_EQ(a.num_rings, b.num_rings);
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (size_t i = 0; i < a.parts.size(); ++i) {
    EXPECT_EQ(a.parts[i].block, b.parts[i].block);
    EXPECT_EQ(a.parts[i].ring, b.parts[i].ring);
    EXPECT_EQ(a.parts[i].slice, b.parts[i].slice);
    EXPECT_EQ(a.parts[i].face_start, b.parts[i].face_start);
    EXPECT_EQ(a.parts[i].num_faces, b.parts[i].num_faces);
    EXPECT_EQ(a.parts[i].volume, b.parts[i].volume);
  }
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (size_t i = 0; i < a.blocks.size(); ++i) {
    const Block &p = a.blocks[i], &q = b.blocks[i];
    EXPECT_EQ(p.kind, q.kind);
    EXPECT_EQ(p.fixed, q.fixed);
    EXPECT_EQ(p.rib, q.rib);
    EXPECT_EQ(p.truncated, q.truncated);
    EXPECT_EQ(p.ring, q.ring);
    EXPECT_EQ(p.num_rings, q.num_rings);
    EXPECT_EQ(p.slot, q.slot);
    EXPECT_EQ(p.sail, q.sail);
    EXPECT_EQ(p.sail_position, q.sail_position);
    EXPECT_EQ(p.spiral, q.spiral);
    EXPECT_EQ(p.density, q.density);
    EXPECT_EQ(p.volume, q.volume);
    EXPECT_EQ(p.mass, q.mass);
    EXPECT_EQ(p.centroid, q.centroid);
    EXPECT_EQ(p.inertia, q.inertia);
  }
  EXPECT_EQ(content_hash(a), content_hash(b));
}

TEST(AssemblyFile, TiesRoundTripExactly) {
  Assembly a = test::two_block_assembly();
  const std::string without = content_hash(a);
  const double infinity = std::numeric_limits<double>::infinity();
  a.ties = {{0, 1, Vec3(0.1, 1.0 / 3.0, 1e-17), Vec3(1, 2, 3), 57265199.0, 1.57998, false, 1.0 / 7.0, 1},
            {1, 0, Vec3(3, 2, 1), Vec3(0, 0, 0), infinity, 0.7625, true}};
  EXPECT_NE(content_hash(a), without);
  a.chains = {{"timber", 7.7}, {"iron", 1.0 / 3.0}};
  const std::string path = test::fresh_folder("a") + "/assembly.vtu";
  write_assembly(path, a);
  const Assembly b = read_assembly(path);
  ASSERT_EQ(b.ties.size(), 2u);
  for (size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(a.ties[k].block_a, b.ties[k].block_a);
    EXPECT_EQ(a.ties[k].block_b, b.ties[k].block_b);
    EXPECT_EQ(a.ties[k].point_a, b.ties[k].point_a);
    EXPECT_EQ(a.ties[k].point_b, b.ties[k].point_b);
    EXPECT_EQ(a.ties[k].stiffness, b.ties[k].stiffness);
    EXPECT_EQ(a.ties[k].length, b.ties[k].length);
    EXPECT_EQ(a.ties[k].pushes, b.ties[k].pushes);
    EXPECT_EQ(a.ties[k].yield_force, b.ties[k].yield_force);
    EXPECT_EQ(a.ties[k].chain, b.ties[k].chain);
    EXPECT_EQ(a.chains[k].name, b.chains[k].name);
    EXPECT_EQ(a.chains[k].height, b.chains[k].height);
  }
  a.ties[0].chain = 2;
  write_assembly(path, a);
  EXPECT_NE(read_error(path).find("tie 0 is invalid"), std::string::npos) << read_error(path);
  a.ties[0].chain = 1;
  a.ties[0].block_b = 7;
  write_assembly(path, a);
  EXPECT_NE(read_error(path).find("tie 0 is invalid"), std::string::npos) << read_error(path);
}

TEST(AssemblyFile, WythesRoundTrip) {
  Assembly a = test::two_block_assembly();
  const std::string without = content_hash(a);
  a.members = {"inner", "outer", "rib"};
  a.member_originals = {"inner", "outer", "inner"};
  a.parts.back().wythe = 1;
  a.blocks.back().member = 2;
  a.vertex_layers.assign(a.vertices.size(), -1);
  a.vertex_depths.assign(a.vertices.size(), 0.0);
  a.vertex_layers.back() = 1;
  a.vertex_depths.back() = 0.25;
  EXPECT_NE(content_hash(a), without);
  const std::string path = test::fresh_folder("a") + "/assembly.vtu";
  write_assembly(path, a);
  const Assembly b = read_assembly(path);
  EXPECT_EQ(b.members, a.members);
  EXPECT_EQ(b.member_originals, a.member_originals);
  EXPECT_EQ(b.parts.front().wythe, 0);
  EXPECT_EQ(b.parts.back().wythe, 1);
  EXPECT_EQ(b.blocks.back().member, 2);
  EXPECT_EQ(b.vertex_layers, a.vertex_layers);
  EXPECT_EQ(b.vertex_depths, a.vertex_depths);
  a.blocks.back().member = 3;
  write_assembly(path, a);
  EXPECT_NE(read_error(path).find("block 1 is invalid"), std::string::npos) << read_error(path);
  a.blocks.back().member = 2;
  a.vertex_depths[0] = 1.5;
  write_assembly(path, a);
  EXPECT_NE(read_error(path).find("layer of vertex 0 is invalid"), std::string::npos) << read_error(path);
}

// A VTK hexahedron lists four points of one face, then the four points across from them. The edges 0-4, 1-5,
// 2-6, 3-7 and a positive determinant at point 0 show that the order is right.
TEST(AssemblyFile, BoxesBecomeHexahedraInVtkOrder) {
  const std::string path = test::fresh_folder("a") + "/assembly.vtu";
  write_assembly(path, test::two_block_assembly());
  const Mesh mesh = read_mesh(path);
  using T = Mesh::CellType;
  EXPECT_EQ(mesh.cell_types, (std::vector{T::hexahedron, T::hexahedron, T::polyhedron}));
  for (int cell = 0; cell < 2; ++cell) {
    const auto point = [&](int i) {
      return Vec3(mesh.points.data() + 3 * mesh.cell_points[mesh.cell_start[cell] + i]);
    };
    const Vec3 up = point(4) - point(0);
    const double volume = up.dot((point(1) - point(0)).cross(point(3) - point(0)));
    const auto& volumes = mesh.array<double>(mesh.cell_data, "volume", 1);
    EXPECT_NEAR(volume, volumes[cell], 1e-15) << "a box's volume is the triple product of its edges";
    for (int i = 1; i < 4; ++i) EXPECT_LT((point(4 + i) - point(i) - up).norm(), 1e-15);
  }
}

TEST(AssemblyFile, CellDataRepeatTheDataOfTheBlocks) {
  const std::string path = test::fresh_folder("a") + "/assembly.vtu";
  write_assembly(path, test::two_block_assembly());
  const Mesh mesh = read_mesh(path);
  EXPECT_EQ(mesh.array<std::int32_t>(mesh.cell_data, "block", 1), (std::vector<std::int32_t>{0, 1, 1}));
  EXPECT_EQ(mesh.array<std::int32_t>(mesh.cell_data, "part", 1), (std::vector<std::int32_t>{0, 0, 1}));
  EXPECT_EQ(mesh.array<std::int32_t>(mesh.cell_data, "slot", 1), (std::vector<std::int32_t>{0, 7, 7}));
  EXPECT_EQ(mesh.array<std::uint8_t>(mesh.cell_data, "flags", 1), (std::vector<std::uint8_t>{0, 3, 3}));
  EXPECT_EQ(mesh.array<std::uint8_t>(mesh.cell_data, "fixed", 1), (std::vector<std::uint8_t>{1, 0, 0}));
}

/// Writes the file with one array changed and a valid checksum; returns the error of reading it.
template <class T>
std::string error_with(const std::string& name, bool in_cells,
                       const std::function<void(std::vector<T>*)>& change) {
  const std::string path = test::fresh_folder(name) + "/assembly.vtu";
  write_assembly(path, test::two_block_assembly());
  Mesh mesh = read_mesh(path);
  for (MeshArray& array : in_cells ? mesh.cell_data : mesh.field_data)
    if (array.name == name) change(&std::get<std::vector<T>>(array.values));
  write_mesh(path, mesh);
  return read_error(path);
}

TEST(AssemblyFile, ErrorsNameInconsistentContent) {
  using Ints = std::vector<std::int32_t>;
  using Doubles = std::vector<double>;
  const auto has = [](const std::string& message, const std::string& part) {
    return testing::AssertionResult(message.find(part) != std::string::npos) << "got: " << message;
  };
  EXPECT_TRUE(
      has(error_with<int>("block", true, [](Ints* v) { (*v)[2] = 5; }), "block of part 2 is invalid"));
  EXPECT_TRUE(has(error_with<int>("block", true,
                                  [](Ints* v) {
                                    *v = {1, 0, 0};
                                  }),
                  "order of part 1 is invalid"));
  EXPECT_TRUE(
      has(error_with<int>("num_faces", true, [](Ints* v) { (*v)[2] = 1 << 30; }), "face range of part 2"));
  EXPECT_TRUE(
      has(error_with<int>("face_vertices", false, [](Ints* v) { (*v)[3] = 18; }), "face vertex id 18"));
  EXPECT_TRUE(has(error_with<int>("face_vertices", false, [](Ints* v) { (*v)[3] = -1; }), "face vertex id"));
  EXPECT_TRUE(has(error_with<int>("face_vertex_start", false, [](Ints* v) { (*v)[1] = 1 << 30; }), "face 0"));
  // Faces whose numbers of corners are positive only because the differences overflow.
  EXPECT_TRUE(has(error_with<int>("face_vertex_start", false,
                                  [](Ints* v) {
                                    (*v)[1] = 1'500'000'000;
                                    (*v)[2] = -1'294'967'296;
                                    for (size_t f = 3; f + 1 < v->size(); ++f)
                                      (*v)[f] = 3 * static_cast<int>(f);
                                  }),
                  "face 0"));
  EXPECT_TRUE(
      has(error_with<int>("format_version", false, [](Ints* v) { (*v)[0] = 99; }), "format version 99"));
  EXPECT_TRUE(has(error_with<double>("block_density", false, [](Doubles* v) { (*v)[1] = -1; }),
                  "block 1 is invalid"));
  EXPECT_TRUE(has(error_with<double>("block_mass", false, [](Doubles* v) { v->pop_back(); }),
                  "`block_mass` has 1 value, expected 2"));
  EXPECT_TRUE(
      has(error_with<double>("block_density", false, [](Doubles* v) { (*v)[1] *= 2; }), "content_hash"));
}

TEST(AssemblyFile, AMeshThatIsNoAssemblyIsRefused) {
  const std::string path = test::fresh_folder("a") + "/mesh.vtu";
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.add_point((i + 1) / 2 % 2, i / 2 % 2, i / 4);
  mesh.add_cell(Mesh::CellType::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
  write_mesh(path, mesh);
  EXPECT_NE(read_error(path).find("is not an assembly file"), std::string::npos);
}

}  // namespace
}  // namespace cupola::assembly_file_test
