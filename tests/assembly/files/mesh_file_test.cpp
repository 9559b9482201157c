#include "assembly/files/mesh_file.hpp"

#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/hash.hpp"
#include "assembly/files/vtk_layout.hpp"
#include "tests/assembly/scene.hpp"

namespace cupola::mesh_file_test {
namespace {

using CellType = Mesh::CellType;

Mesh polygonal_mesh() {
  Mesh mesh;
  for (int i = 0; i < 5; ++i) mesh.add_point(0.1 * i, 1.0 / 3.0 + i, 1e-300 * i);
  mesh.add_cell(CellType::vertex, {4});
  mesh.add_cell(CellType::polyline, {0, 1, 2});
  mesh.add_cell(CellType::polygon, {3, 1, 0});
  mesh.point_data = {
      {"numbers", 1, std::vector<double>{0.1, -0.0, 5e-324, 1.7976931348623157e308, 2.0 / 3.0}},
      {"ids", 1, std::vector<std::int32_t>{-7, 0, 2147483647, -2147483647, 1}}};
  mesh.cell_data = {{"vector", 3, std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}},
                    {"bytes", 1, std::vector<std::uint8_t>{0, 255, 3}}};
  mesh.field_data = {{"texts", 1, std::vector<std::string>{"a <b> & \"c\"", "", "dôme"}},
                     {"one", 1, std::vector<std::int32_t>{42}}};
  return mesh;
}

void expect_same_arrays(const std::vector<MeshArray>& a, const std::vector<MeshArray>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].components, b[i].components);
    EXPECT_TRUE(a[i].values == b[i].values) << a[i].name;
  }
}

void expect_same_mesh(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.cell_types, b.cell_types);
  EXPECT_EQ(a.cell_start, b.cell_start);
  EXPECT_EQ(a.cell_points, b.cell_points);
  expect_same_arrays(a.point_data, b.point_data);
  expect_same_arrays(a.cell_data, b.cell_data);
  expect_same_arrays(a.field_data, b.field_data);
}

Mesh solid_mesh() {
  Mesh mesh;
  for (int z = 0; z < 3; ++z)
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      mesh.add_point(x, y, z);
  mesh.add_cell(CellType::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7});
  mesh.add_cell(CellType::polyhedron, {5, 4, 7, 6, 5, 4, 3, 4, 5, 8, 3, 5, 6, 8, 3, 6, 7, 8, 3, 7, 4, 8});
  mesh.cell_data = {{"id", 1, std::vector<std::int32_t>{10, 11}}};
  return mesh;
}

/// The message of the error that reading the file raises, or "" if there is none.
std::string read_error(const std::string& path) {
  try {
    read_mesh(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Writes without the flush to disk of write_text_atomically, to save time.
void write_plainly(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

TEST(MeshFile, PolygonalDataRoundTripExactly) {
  const std::string path = test::fresh_folder("a") + "/mesh.vtp";
  write_mesh(path, polygonal_mesh());
  expect_same_mesh(read_mesh(path), polygonal_mesh());
}

TEST(MeshFile, SolidCellsRoundTripExactly) {
  const std::string path = test::fresh_folder("a") + "/mesh.vtu";
  write_mesh(path, solid_mesh());
  expect_same_mesh(read_mesh(path), solid_mesh());
}

TEST(MeshFile, NanAndInfinityRoundTrip) {
  const std::string path = test::fresh_folder("a") + "/mesh.vtp";
  Mesh mesh;
  mesh.add_point(0, 0, 0);
  mesh.add_cell(CellType::vertex, {0});
  mesh.field_data = {{"odd", 1, std::vector<double>{std::nan(""), std::numeric_limits<double>::infinity()}}};
  write_mesh(path, mesh);
  const Mesh back = read_mesh(path);
  const auto& odd = back.array<double>(back.field_data, "odd", 1);
  EXPECT_TRUE(std::isnan(odd[0]));
  EXPECT_TRUE(std::isinf(odd[1]));
}

TEST(MeshFile, EmptyMeshRoundTrips) {
  const std::string path = test::fresh_folder("a") + "/mesh.vtp";
  Mesh mesh;
  mesh.point_data = {{"force_N", 3, std::vector<double>{}}, {"ids", 1, std::vector<std::int32_t>{}}};
  write_mesh(path, mesh);
  expect_same_mesh(read_mesh(path), mesh);
}

TEST(MeshFile, WritesTheSameBytesTwice) {
  const std::string folder = test::fresh_folder("a");
  write_mesh(folder + "/1.vtu", solid_mesh());
  write_mesh(folder + "/2.vtu", solid_mesh());
  EXPECT_EQ(read_text(folder + "/1.vtu"), read_text(folder + "/2.vtu"));
}

TEST(MeshFile, EveryTruncationIsAnInputErrorAndPrintsNothing) {
  const std::string folder = test::fresh_folder("a");
  write_mesh(folder + "/mesh.vtu", solid_mesh());
  const std::string text = read_text(folder + "/mesh.vtu");
  const std::string checksum_line = text.substr(text.rfind("<!--"));
  testing::internal::CaptureStderr();
  for (size_t size = 0; size + checksum_line.size() < text.size(); size += 19) {
    write_plainly(folder + "/cut.vtu", text.substr(0, size));
    EXPECT_NE(read_error(folder + "/cut.vtu"), "") << size << " of " << text.size() << " bytes";
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(MeshFile, EveryChangedByteIsAnInputErrorAndPrintsNothing) {
  const std::string folder = test::fresh_folder("a");
  write_mesh(folder + "/mesh.vtp", polygonal_mesh());
  const std::string text = read_text(folder + "/mesh.vtp");
  testing::internal::CaptureStderr();
  for (size_t at = 0; at < text.size(); at += 11) {
    std::string changed = text;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    write_plainly(folder + "/changed.vtp", changed);
    EXPECT_NE(read_error(folder + "/changed.vtp"), "") << "byte " << at;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// Invalid counts, in a file whose checksum is missing or does not match.
TEST(MeshFile, EditedCountsAreRefused) {
  const std::string folder = test::fresh_folder("a");
  write_mesh(folder + "/mesh.vtu", solid_mesh());
  const std::string text = read_text(folder + "/mesh.vtu");
  for (const std::string value : {"99999999999999", "-1", "1e308", "nan", "many"}) {
    std::string changed = text;
    const size_t at = changed.find("NumberOfPoints=\"") + 16;
    changed.replace(at, changed.find('"', at) - at, value);
    write_text_atomically(folder + "/bad.vtu", changed);
    EXPECT_NE(read_error(folder + "/bad.vtu").find("is damaged or was edited"), std::string::npos) << value;
    write_text_atomically(folder + "/bad.vtu", changed.substr(0, changed.rfind("<!--")));
    EXPECT_NE(read_error(folder + "/bad.vtu").find("was not written by Cupola"), std::string::npos) << value;
  }
}

/// The error of reading the file after the text that follows `start` is replaced (up to the next quote, or
/// the same length), with a valid checksum.
std::string error_of_forged(const std::string& text, const std::string& start, const std::string& other) {
  const std::string path = test::fresh_folder("forged") + "/forged.vtu";
  std::string body = text.substr(0, text.rfind("<!--"));
  const size_t at = body.find(start) + start.size();
  body.replace(at, start.ends_with('"') ? body.find('"', at) - at : other.size(), other);
  write_text_atomically(path, body + "<!-- xxh3-128 " + hash_text(body) + " -->\n");
  return read_error(path);
}

// VTK allocates the memory that a file declares before it reads the data.
TEST(MeshFile, DeclaredSizesAreCheckedDespiteAValidChecksum) {
  const std::string path = test::fresh_folder("a") + "/mesh.vtu";
  write_mesh(path, solid_mesh());
  const std::string text = read_text(path);
  EXPECT_EQ(error_of_forged(text, "NumberOfPoints=\"", "12"), "");  // unchanged
  for (const std::string value : {"99999999999999", "-1", "1e308", "nan", "many"}) {
    for (const std::string attribute : {"NumberOfPoints", "NumberOfCells", "offset"}) {
      const std::string error = error_of_forged(text, attribute + "=\"", value);
      EXPECT_NE(error.find("declares more data than its"), std::string::npos) << attribute << ": " << error;
    }
  }
  // Headers of compressed data: 2^56 blocks; one block of 2^56 bytes; one block, the last of 2^56 bytes.
  const std::string data(kAppended);
  ASSERT_NE(text.find(data), std::string::npos);
  for (const std::string header : {"AAAAAAAAAAEAgAAAAAAAAAgAAAAAAAAA", "AQAAAAAAAAAAAAAAAAAAAQgAAAAAAAAA",
                                   "AQAAAAAAAAAAgAAAAAAAAAAAAAAAAAAB"})
    EXPECT_NE(error_of_forged(text, data, header).find("declares more data"), std::string::npos) << header;
}

// ParaView 5.11 with a recent expat reads files only without the attribute. Files with it, which version
// 0.1.0 wrote, are read too.
TEST(MeshFile, AppendedDataStartWithAndWithoutEncoding) {
  const std::string path = test::fresh_folder("a") + "/mesh.vtu";
  write_mesh(path, solid_mesh());
  std::string text = read_text(path);
  const size_t at = text.find("<AppendedData>");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, kAppendedByVtk.size(), kAppendedByVtk);
  EXPECT_EQ(error_of_forged(text, "<?xml version=\"", "1.0"), "");
}

// VTK aborts the process if some elements or attributes are missing.
TEST(MeshFile, LayoutIsCheckedDespiteAValidChecksum) {
  const std::string path = test::fresh_folder("a") + "/mesh.vtu";
  write_mesh(path, solid_mesh());
  const std::string text = read_text(path);
  const auto with = [&](const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return error_of_forged(text.substr(0, at) + to + text.substr(at + from.size()), "<?xml version=\"",
                           "1.0");
  };
  EXPECT_EQ(with("Name=\"id\"", "Name=\"it\""), "");
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"DataArray type", "DataArray t2ype"},
                                                        {"type=\"Int32\"", "type=\"Bit\""},
                                                        {"<Points>", "<Cells>"},
                                                        {"</Points>", ""},
                                                        {"<Piece ", "<Piece NumberOfPoints=\"1\" "},
                                                        {"NumberOfCells", "NumberOfVerts"},
                                                        {"UnstructuredGrid\"", "PolyData\""},
                                                        {"<Points>", "<FieldData></FieldData><Points>"},
                                                        {"vtkZLib", "vtkLZ4"},
                                                        {"<VTKFile", "<!DOCTYPE x><VTKFile"},
                                                        {"<AppendedData", "<Appended"}})
    EXPECT_NE(with(from, to).find(" element"), std::string::npos) << from << ": " << with(from, to);
}

TEST(MeshFile, ErrorsNameAMissingOrForeignFile) {
  const std::string folder = test::fresh_folder("a");
  EXPECT_NE(read_error(folder + "/none.vtu").find("none.vtu: error: does not exist"), std::string::npos);
  write_text_atomically(folder + "/foreign.vtp", "hello");
  EXPECT_NE(read_error(folder + "/foreign.vtp").find("is not a VTK XML file"), std::string::npos);
  // A .vtp file with the extension .vtu.
  write_mesh(folder + "/mesh.vtp", polygonal_mesh());
  write_text_atomically(folder + "/mesh.vtu", read_text(folder + "/mesh.vtp"));
  EXPECT_NE(read_error(folder + "/mesh.vtu"), "");
}

TEST(MeshFile, ArrayErrorsNameFileAndArray) {
  const std::string path = test::fresh_folder("a") + "/mesh.vtp";
  write_mesh(path, polygonal_mesh());
  const Mesh mesh = read_mesh(path);
  EXPECT_EQ(mesh.field<std::int32_t>("one"), 42);
  const auto message = [&](auto&& read) -> std::string {
    try {
      read();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([&] { mesh.array<double>(mesh.point_data, "nothing", 1); }),
            path + ": error: array `nothing` is missing");
  EXPECT_EQ(message([&] { mesh.array<double>(mesh.point_data, "ids", 1); }),
            path + ": error: array `ids` must have the type Float64");
  EXPECT_EQ(message([&] { mesh.array<double>(mesh.cell_data, "vector", 1); }),
            path + ": error: array `vector` has 3 components, expected 1");
  EXPECT_EQ(message([&] { mesh.field<std::string>("texts"); }),
            path + ": error: field `texts` has 3 values, expected 1");
}

TEST(MeshFile, FailedWriteKeepsTheOldFile) {
  EXPECT_THROW(write_mesh("/nowhere/at/all/mesh.vtp", polygonal_mesh()), SystemError);
  const std::string path = test::fresh_folder("a") + "/mesh.vtp";
  write_mesh(path, polygonal_mesh());
  EXPECT_THROW(write_mesh(path, solid_mesh()), std::invalid_argument);
  expect_same_mesh(read_mesh(path), polygonal_mesh());
}

TEST(PvdFile, RoundTripsTimesAndNames) {
  const std::string path = test::fresh_folder("a") + "/series.pvd";
  const std::vector<PvdEntry> entries{
      {0.0, "a_0000.vtp"}, {1e-300, "b & <c>.vtp"}, {1.0 / 3.0, "d \"e\".vtp"}};
  write_pvd(path, entries);
  const auto back = read_pvd(path);
  ASSERT_EQ(back.size(), entries.size());
  for (size_t i = 0; i < entries.size(); ++i) {
    EXPECT_EQ(back[i].time, entries[i].time);
    EXPECT_EQ(back[i].file, entries[i].file);
  }
}

// ParaView sorts the files by time and merges those of one time: a path past its largest load would be
// shuffled.
TEST(PvdFile, NumbersFilesWhoseTimesDoNotIncrease) {
  const std::string path = test::fresh_folder("a") + "/series.pvd";
  for (const double last : {0.5, 0.25}) {
    write_pvd(path, {{0.0, "a"}, {0.5, "b"}, {last, "c"}});
    const auto back = read_pvd(path);
    ASSERT_EQ(back.size(), 3U);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(back[i].time, i);
    EXPECT_EQ(back[2].file, "c");
  }
}

TEST(PvdFile, BadCollectionsAreInputErrors) {
  const std::string folder = test::fresh_folder("a");
  EXPECT_THROW(read_pvd(folder + "/none.pvd"), InputError);
  for (const std::string text :
       {"", "<VTKFile type=\"Collection\"><Collection>", "<VTKFile/>",
        "<VTKFile><Collection><DataSet file=\"a\"/></Collection></VTKFile>",
        "<VTKFile><Collection><DataSet file=\"a\" timestep=\"soon\"/></Collection></VTKFile>"}) {
    write_text_atomically(folder + "/bad.pvd", text);
    EXPECT_THROW(read_pvd(folder + "/bad.pvd"), InputError) << text;
  }
}

}  // namespace
}  // namespace cupola::mesh_file_test
