// Reads and writes .vtu and .vtp files, and reads .pvd collections. The only file of assembly/ with VTK data
// types.
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>

#include <fmt/format.h>
#include <libdeflate.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkStringOutputWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkXMLUtilities.h>
#include <vtkZLibDataCompressor.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/hash.hpp"
#include "assembly/files/mesh_file.hpp"
#include "assembly/files/vtk_layout.hpp"

namespace cupola {
namespace {

using CellType = Mesh::CellType;

// The last line of a file: an XML comment that holds a checksum of all bytes before it.
constexpr std::string_view kChecksumStart = "<!-- xxh3-128 ";
constexpr std::string_view kChecksumEnd = " -->\n";

/// Collects the messages that VTK would print on stderr during its lifetime.
class CapturedVtkMessages {
 public:
  CapturedVtkMessages() : previous_(vtkOutputWindow::GetInstance()) {
    vtkOutputWindow::SetInstance(window_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // the logger does not use the window
  }
  ~CapturedVtkMessages() { vtkOutputWindow::SetInstance(previous_); }
  CapturedVtkMessages(const CapturedVtkMessages&) = delete;
  CapturedVtkMessages& operator=(const CapturedVtkMessages&) = delete;

  bool any() { return !window_->GetOutput().empty(); }
  /// The first message without its source location: the text after "): " up to the end of the line.
  std::string first() {
    std::string text = window_->GetOutput();
    if (const size_t at = text.find("): "); at != std::string::npos) text = text.substr(at + 3);
    return text.substr(0, text.find('\n'));
  }

 private:
  vtkSmartPointer<vtkOutputWindow> previous_;
  vtkNew<vtkStringOutputWindow> window_;
};

bool is_polygonal(const std::string& path) {
  return std::filesystem::path(path).extension() == ".vtp";
}

// ---------------------------------------------------------------- writing

template <class VtkArray, class T>
vtkSmartPointer<vtkAbstractArray> wrapped(const std::vector<T>& values, int components) {
  // VTK only reads through this pointer, and the mesh outlives the array.
  auto array = vtkSmartPointer<VtkArray>::New();
  array->SetNumberOfComponents(components);
  array->SetArray(const_cast<T*>(values.data()), static_cast<vtkIdType>(values.size()), /*save=*/1);
  return array;
}

vtkSmartPointer<vtkAbstractArray> to_vtk(const MeshArray& array) {
  if (const auto* doubles = std::get_if<std::vector<double>>(&array.values))
    return wrapped<vtkDoubleArray>(*doubles, array.components);
  if (const auto* ints = std::get_if<std::vector<std::int32_t>>(&array.values))
    return wrapped<vtkIntArray>(*ints, array.components);
  if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&array.values))
    return wrapped<vtkUnsignedCharArray>(*bytes, array.components);
  auto strings = vtkSmartPointer<vtkStringArray>::New();
  for (const std::string& text : std::get<std::vector<std::string>>(array.values))
    strings->InsertNextValue(text);
  return strings;
}

void add_arrays(const std::vector<MeshArray>& arrays, vtkFieldData* data) {
  for (const MeshArray& array : arrays) {
    const auto vtk_array = to_vtk(array);
    vtk_array->SetName(array.name.c_str());
    data->AddArray(vtk_array);
  }
}

vtkSmartPointer<vtkPoints> vtk_points(const Mesh& mesh) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(vtkDataArray::SafeDownCast(wrapped<vtkDoubleArray>(mesh.points, 3)));
  return points;
}

/// Offsets and point ids of a sequence of cells, as VTK stores them.
struct CellArrays {
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> ids;

  CellArrays() { offsets->InsertNextValue(0); }
  void end_cell() { offsets->InsertNextValue(ids->GetNumberOfTuples()); }
  vtkSmartPointer<vtkCellArray> cells() {
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    cells->SetData(offsets.Get(), ids.Get());
    return cells;
  }
};

vtkSmartPointer<vtkUnstructuredGrid> to_unstructured_grid(const Mesh& mesh) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(vtk_points(mesh));
  CellArrays cells;
  vtkNew<vtkUnsignedCharArray> types;
  vtkNew<vtkIdTypeArray> faces;
  vtkNew<vtkIdTypeArray> face_locations;
  std::vector<int> corners;
  for (int i = 0; i < mesh.num_cells(); ++i) {
    const int begin = mesh.cell_start[i];
    const int end = mesh.cell_start[i + 1];
    if (mesh.cell_types[i] == CellType::hexahedron) {
      types->InsertNextValue(VTK_HEXAHEDRON);
      face_locations->InsertNextValue(-1);
      for (int j = begin; j < end; ++j) cells.ids->InsertNextValue(mesh.cell_points[j]);
    } else if (mesh.cell_types[i] == CellType::polyhedron) {
      types->InsertNextValue(VTK_POLYHEDRON);
      face_locations->InsertNextValue(faces->GetNumberOfTuples());
      corners.clear();
      for (int j = begin; j < end; ++j) faces->InsertNextValue(mesh.cell_points[j]);
      for (int j = begin + 1; j < end; j += mesh.cell_points[j] + 1)
        for (int k = 1; k <= mesh.cell_points[j]; ++k) corners.push_back(mesh.cell_points[j + k]);
      std::sort(corners.begin(), corners.end());
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      for (const int id : corners) cells.ids->InsertNextValue(id);
    } else {
      throw std::invalid_argument("only hexahedra and polyhedra can be written to a .vtu file");
    }
    cells.end_cell();
  }
  if (faces->GetNumberOfTuples() > 0)
    grid->SetCells(types, cells.cells(), face_locations, faces);
  else
    grid->SetCells(types, cells.cells());
  return grid;
}

vtkSmartPointer<vtkPolyData> to_poly_data(const Mesh& mesh) {
  CellArrays verts, lines, polygons;
  // A .vtp file stores vertices, then lines, then polygons; the cell data follow that order.
  if (!std::is_sorted(mesh.cell_types.begin(), mesh.cell_types.end()))
    throw std::invalid_argument("cells of a .vtp file must come as vertices, polylines, polygons");
  for (int i = 0; i < mesh.num_cells(); ++i) {
    const CellType type = mesh.cell_types[i];
    if (type > CellType::polygon) throw std::invalid_argument("solid cells cannot be written to a .vtp file");
    CellArrays& cells = type == CellType::vertex ? verts : type == CellType::polyline ? lines : polygons;
    for (int j = mesh.cell_start[i]; j < mesh.cell_start[i + 1]; ++j)
      cells.ids->InsertNextValue(mesh.cell_points[j]);
    cells.end_cell();
  }
  auto poly_data = vtkSmartPointer<vtkPolyData>::New();
  poly_data->SetPoints(vtk_points(mesh));
  poly_data->SetVerts(verts.cells());
  poly_data->SetLines(lines.cells());
  poly_data->SetPolys(polygons.cells());
  return poly_data;
}

/// zlib's format, written by libdeflate in half the time. Throws if there is no memory for compression; VTK's
/// writers would continue with a null pointer.
class Compressor : public vtkZLibDataCompressor {
 public:
  static Compressor* New() {
    auto* compressor = new Compressor;
    compressor->InitializeObjectBase();
    return compressor;
  }

 private:
  size_t GetMaximumCompressionSpace(size_t size) override {
    return libdeflate_zlib_compress_bound(deflate_.get(), size);
  }
  size_t CompressBuffer(const unsigned char* data, size_t size, unsigned char* compressed,
                        size_t space) override {
    if (deflate_ == nullptr) throw std::bad_alloc();
    return libdeflate_zlib_compress(deflate_.get(), data, size, compressed, space);
  }

  // Level 2 saves 1 % of the bytes of 82,048 blocks, for 6 % more time of their evaluation.
  std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> deflate_{
      libdeflate_alloc_compressor(1), &libdeflate_free_compressor};
};

template <class Writer>
void write_data(const std::string& side_path, vtkDataSet* data, const Mesh& mesh) {
  add_arrays(mesh.point_data, data->GetPointData());
  add_arrays(mesh.cell_data, data->GetCellData());
  add_arrays(mesh.field_data, data->GetFieldData());
  vtkNew<Writer> writer;
  writer->SetCompressor(vtkNew<Compressor>());
  writer->SetFileName(side_path.c_str());
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOn();  // raw appended data is not well-formed XML
  writer->SetHeaderTypeToUInt64();
  writer->SetBlockSize(1U << 18U);  // bytes; in those of 32 kB, the default, points take a quarter more
  CapturedVtkMessages messages;
  errno = 0;  // VTK's messages do not say why the system refused
  if (writer->Write() == 1 && !messages.any()) return;
  const int reason = errno;
  throw SystemError(fmt::format("{}: cannot be written: {}", side_path,
                                reason != 0 ? std::strerror(reason) : messages.first()));
}

void append_checksum(const std::string& side_path) {
  const std::string line = fmt::format("{}{}{}", kChecksumStart, hash_file(side_path), kChecksumEnd);
  std::ofstream out(side_path, std::ios::binary | std::ios::app);
  out << line;
  out.close();
  if (!out) throw SystemError(side_path + ": cannot be written");
}

// ---------------------------------------------------------------- reading

[[noreturn]] void reject(const std::string& path, const std::string& why) {
  throw InputError(FileLocation{path}, why);
}

/// Refuses files other than those written by write_mesh. VTK's readers trust the counts and offsets of a file
/// (one changed digit can cause a division by zero), so they get intact files only.
void check_bytes(const std::string& path) {
  const std::string content = read_text(path);
  const std::string_view text = content;
  if (text.find("<VTKFile") == std::string_view::npos) reject(path, "is not a VTK XML file");
  if (text.find("</VTKFile>") == std::string_view::npos) reject(path, "is truncated: its end is missing");
  const size_t start = text.rfind(kChecksumStart);
  if (start == std::string_view::npos || !text.ends_with(kChecksumEnd))
    reject(path, "was not written by Cupola: its last line is not a checksum");
  const size_t digits = text.size() - kChecksumEnd.size() - start - kChecksumStart.size();
  if (hash_text(text.substr(0, start)) != text.substr(start + kChecksumStart.size(), digits))
    reject(path, "is damaged or was edited: its bytes do not match the checksum in its last line");
  // A checksum can be forged.
  if (const std::string why = layout_defect(text); !why.empty()) reject(path, why);
}

MeshArray from_vtk(const std::string& path, vtkAbstractArray* array) {
  MeshArray out;
  out.name = array->GetName() ? array->GetName() : "";
  out.components = array->GetNumberOfComponents();
  if (auto* doubles = vtkDoubleArray::SafeDownCast(array)) {
    out.values =
        std::vector<double>(doubles->GetPointer(0), doubles->GetPointer(0) + doubles->GetNumberOfValues());
  } else if (auto* ints = vtkIntArray::SafeDownCast(array)) {
    out.values =
        std::vector<std::int32_t>(ints->GetPointer(0), ints->GetPointer(0) + ints->GetNumberOfValues());
  } else if (auto* bytes = vtkUnsignedCharArray::SafeDownCast(array)) {
    out.values =
        std::vector<std::uint8_t>(bytes->GetPointer(0), bytes->GetPointer(0) + bytes->GetNumberOfValues());
  } else if (auto* strings = vtkStringArray::SafeDownCast(array)) {
    std::vector<std::string> values;
    for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i) values.push_back(strings->GetValue(i));
    out.values = std::move(values);
  } else {
    reject(path, fmt::format("array `{}` has an unknown type", out.name));
  }
  return out;
}

std::vector<MeshArray> arrays_of(const std::string& path, vtkFieldData* data, vtkIdType tuples) {
  std::vector<MeshArray> arrays;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (tuples >= 0 && array->GetNumberOfTuples() != tuples)
      reject(path, fmt::format("array `{}` has {}, expected {}", array->GetName() ? array->GetName() : "",
                               counted(array->GetNumberOfTuples(), "row"), tuples));
    arrays.push_back(from_vtk(path, array));
  }
  return arrays;
}

void read_points(vtkPointSet* data, Mesh* mesh) {
  mesh->points.resize(3 * static_cast<size_t>(data->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) data->GetPoint(i, mesh->points.data() + 3 * i);
}

int checked_point(vtkIdType id, const Mesh& mesh) {
  if (id < 0 || id >= mesh.num_points())
    reject(mesh.file, fmt::format("a cell refers to point {}, but there are only {}", id,
                                  counted(mesh.num_points(), "point")));
  return static_cast<int>(id);
}

void read_cells(vtkCellArray* cells, CellType type, Mesh* mesh) {
  std::vector<int> ids;
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i) {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    cells->GetCellAtId(i, size, points);
    ids.clear();
    for (vtkIdType j = 0; j < size; ++j) ids.push_back(checked_point(points[j], *mesh));
    mesh->add_cell(type, ids);
  }
}

/// Copies the sequence [num_faces, size, ids..., size, ids...] that starts at `location` in VTK's face
/// stream.
std::vector<int> face_stream(vtkIdTypeArray* faces, vtkIdType location, const Mesh& mesh) {
  const vtkIdType end = faces ? faces->GetNumberOfTuples() : 0;
  vtkIdType at = location;
  const auto next = [&] {
    if (at < 0 || at >= end) reject(mesh.file, "the faces of a polyhedron are incomplete");
    return faces->GetValue(at++);
  };
  std::vector<int> stream;
  const vtkIdType num_faces = next();
  stream.push_back(static_cast<int>(num_faces));
  for (vtkIdType f = 0; f < num_faces; ++f) {
    const vtkIdType size = next();
    stream.push_back(static_cast<int>(size));
    for (vtkIdType j = 0; j < size; ++j) stream.push_back(checked_point(next(), mesh));
  }
  return stream;
}

void fill_mesh(vtkUnstructuredGrid* grid, Mesh* mesh) {
  read_points(grid, mesh);
  vtkIdTypeArray* locations = grid->GetFaceLocations();
  std::vector<int> ids;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i) {
    if (grid->GetCellType(i) == VTK_POLYHEDRON) {
      const vtkIdType location =
          locations && i < locations->GetNumberOfTuples() ? locations->GetValue(i) : -1;
      mesh->add_cell(CellType::polyhedron, face_stream(grid->GetFaces(), location, *mesh));
      continue;
    }
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    grid->GetCells()->GetCellAtId(i, size, points);
    if (grid->GetCellType(i) != VTK_HEXAHEDRON || size != 8)
      reject(mesh->file, fmt::format("cell {} is neither a hexahedron nor a polyhedron", i));
    ids.clear();
    for (vtkIdType j = 0; j < size; ++j) ids.push_back(checked_point(points[j], *mesh));
    mesh->add_cell(CellType::hexahedron, ids);
  }
}

void fill_mesh(vtkPolyData* data, Mesh* mesh) {
  read_points(data, mesh);
  read_cells(data->GetVerts(), CellType::vertex, mesh);
  read_cells(data->GetLines(), CellType::polyline, mesh);
  read_cells(data->GetPolys(), CellType::polygon, mesh);
}

template <class Reader>
Mesh read_data(const std::string& path) {
  CapturedVtkMessages messages;
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  try {
    reader->Update();
  } catch (const std::bad_alloc&) {
    throw;  // no fault of the file
  } catch (const std::exception& error) {
    reject(path, fmt::format("cannot be read: {}", error.what()));
  }
  if (messages.any() || reader->GetErrorCode() != 0)
    reject(path, fmt::format("cannot be read: {}", messages.first()));
  Mesh mesh;
  mesh.file = path;
  auto* data = reader->GetOutput();
  fill_mesh(data, &mesh);
  mesh.point_data = arrays_of(path, data->GetPointData(), mesh.num_points());
  mesh.cell_data = arrays_of(path, data->GetCellData(), mesh.num_cells());
  mesh.field_data = arrays_of(path, data->GetFieldData(), -1);
  return mesh;
}

}  // namespace

void write_mesh(const std::string& path, const Mesh& mesh) {
  // VTK's threads would save no time and may fail to start. VTK's own switch cannot be used: its header is
  // not valid C++20.
  ::setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 0);
  write_atomically(path, [&](const std::string& side_path) {
    if (is_polygonal(path))
      write_data<vtkXMLPolyDataWriter>(side_path, to_poly_data(mesh), mesh);
    else
      write_data<vtkXMLUnstructuredGridWriter>(side_path, to_unstructured_grid(mesh), mesh);
    shorten_appended_tag(side_path);
    append_checksum(side_path);
    return true;
  });
}

Mesh read_mesh(const std::string& path) {
  check_bytes(path);
  require_memory(4 << 20);  // VTK's parser crashes without; larger arrays throw
  return is_polygonal(path) ? read_data<vtkXMLPolyDataReader>(path)
                            : read_data<vtkXMLUnstructuredGridReader>(path);
}

std::vector<PvdEntry> read_pvd(const std::string& path) {
  const std::string text = read_text(path);
  CapturedVtkMessages messages;
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(text.c_str()));
  if (!root || messages.any()) reject(path, "is not a complete XML file");
  vtkXMLDataElement* collection = root->FindNestedElementWithName("Collection");
  if (!collection) reject(path, "is not a ParaView collection (.pvd)");
  std::vector<PvdEntry> entries;
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* element = collection->GetNestedElement(i);
    const char* file = element->GetAttribute("file");
    const char* time = element->GetAttribute("timestep");
    if (!file || !time) reject(path, fmt::format("entry {} lacks its file or timestep", i));
    const std::string_view digits(time);
    PvdEntry entry{0.0, file};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), entry.time);
    if (error != std::errc() || end != digits.data() + digits.size())
      reject(path, fmt::format("entry {}: timestep `{}` is not a number", i, time));
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace cupola
