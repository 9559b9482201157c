#include "assembly/files/results_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/hash.hpp"
#include "assembly/files/mesh_file.hpp"
#include "assembly/files/old_frames.hpp"
#include "assembly/files/summary_file.hpp"
#include "assembly/records/frame_record.hpp"

namespace cupola {
namespace {

constexpr std::int32_t kFrameFormatVersion = 3, kOldestFrameFormat = 2;

std::string in_folder(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

std::string frame_file(const char* what, int index) {
  return fmt::format("{}_{:04}.vtp", what, index);
}

template <class Vector>
std::vector<double> flat(const std::vector<Vector>& vectors) {
  std::vector<double> values;
  values.reserve(vectors.size() * Vector::SizeAtCompileTime);
  for (const Vector& v : vectors) values.insert(values.end(), v.begin(), v.end());
  return values;
}

template <class Vector>
std::vector<Vector> unflat(const std::vector<double>& values) {
  std::vector<Vector> vectors;
  vectors.reserve(values.size() / Vector::SizeAtCompileTime);
  for (size_t i = 0; i < values.size(); i += Vector::SizeAtCompileTime)
    vectors.emplace_back(values.data() + i);
  return vectors;
}

/// The columns of a table of a frame as arrays of a mesh.
struct ArrayWriter {
  size_t rows;
  std::vector<MeshArray>& arrays;

  template <class T>
  void operator()(const char* key, const char*, const char*, const std::vector<T>& column) const {
    CUPOLA_ASSERT(column.size() == rows);
    if constexpr (requires { T::SizeAtCompileTime; })
      arrays.push_back({key, T::SizeAtCompileTime, flat(column)});
    else if constexpr (std::is_enum_v<T>)
      arrays.push_back({key, 1, std::vector<std::uint8_t>(numbers(column))});
    else
      arrays.push_back({key, 1, column});
  }
  template <class Column>
  void operator()(const char* key, const char* unit, const char* meaning, Optional<Column> optional) const {
    if (!optional.column.empty()) (*this)(key, unit, meaning, optional.column);
  }

 private:
  template <class Enum>
  static std::vector<std::uint8_t> numbers(const std::vector<Enum>& column) {
    std::vector<std::uint8_t> values(column.size());
    std::transform(column.begin(), column.end(), values.begin(),
                   [](Enum value) { return static_cast<std::uint8_t>(value); });
    return values;
  }
};

/// Its reverse. Throws InputError for an array that is missing or of another type, and for the number of no kind.
struct ArrayReader {
  const Mesh& mesh;
  const std::vector<MeshArray>& arrays;

  template <class T>
  void operator()(const char* key, const char*, const char*, std::vector<T>& column) const {
    if constexpr (requires { T::SizeAtCompileTime; }) {
      column = unflat<T>(mesh.array<double>(arrays, key, T::SizeAtCompileTime));
    } else if constexpr (std::is_enum_v<T>) {
      for (const std::uint8_t value : mesh.array<std::uint8_t>(arrays, key, 1)) {
        if (value >= enum_names(T{}).size())
          throw InputError(FileLocation{mesh.file}, fmt::format("{} {} is unknown", key, value));
        column.push_back(static_cast<T>(value));
      }
    } else {
      column = mesh.array<T>(arrays, key, 1);
    }
  }
  template <class Column>
  void operator()(const char* key, const char* unit, const char* meaning, Optional<Column> optional) const {
    if (mesh.has(arrays, key)) (*this)(key, unit, meaning, optional.column);
  }
};

std::vector<MeshArray> frame_fields(const Frame& frame, const std::string& assembly_hash) {
  return {{"format_version", 1, std::vector<std::int32_t>{kFrameFormatVersion}},
          {"program_version", 1, std::vector<std::string>{program_version()}},
          {"assembly_hash", 1, std::vector<std::string>{assembly_hash}},
          {"time_s", 1, std::vector<double>{frame.time}},
          {"role", 1, std::vector<std::string>{to_string(frame.role)}},
          {"owner", 1, std::vector<std::string>{frame.owner}},
          {"label", 1, std::vector<std::string>{frame.label}}};
}

/// Adds one vertex cell per point, so that ParaView shows the points.
Mesh point_mesh(const std::vector<Vec3>& points, const Frame& frame, const std::string& assembly_hash) {
  Mesh mesh;
  mesh.points = flat(points);
  for (int i = 0; i < mesh.num_points(); ++i) mesh.add_cell(Mesh::CellType::vertex, {i});
  mesh.field_data = frame_fields(frame, assembly_hash);
  return mesh;
}

Mesh contacts_mesh(const Frame& frame, const std::string& assembly_hash) {
  const ContactTable& contacts = frame.contacts;
  Mesh mesh = point_mesh(contacts.point, frame, assembly_hash);
  fields(ArrayWriter{contacts.point.size(), mesh.point_data}, contacts);
  return mesh;
}

Mesh blocks_mesh(const Frame& frame, const std::string& assembly_hash) {
  const BlockTable& blocks = frame.blocks;
  Mesh mesh = point_mesh(blocks.position, frame, assembly_hash);
  std::vector<std::int32_t> ids(blocks.position.size());
  std::iota(ids.begin(), ids.end(), 0);
  mesh.point_data = {{"block", 1, std::move(ids)}};
  fields(ArrayWriter{blocks.position.size(), mesh.point_data}, blocks);
  return mesh;
}

/// One segment per tie.
Mesh ties_mesh(const Frame& frame, const std::string& assembly_hash) {
  const TieTable& ties = frame.ties;
  CUPOLA_ASSERT(ties.point_a.size() == ties.force.size() && ties.point_b.size() == ties.force.size());
  Mesh mesh;
  mesh.field_data = frame_fields(frame, assembly_hash);
  for (int i = 0; i < ties.size(); ++i) {
    const int a = mesh.add_point(ties.point_a[i].x(), ties.point_a[i].y(), ties.point_a[i].z());
    const int b = mesh.add_point(ties.point_b[i].x(), ties.point_b[i].y(), ties.point_b[i].z());
    mesh.add_cell(Mesh::CellType::polyline, {a, b});
  }
  fields(ArrayWriter{ties.force.size(), mesh.cell_data}, ties);
  return mesh;
}

/// Reads a file of a frame and checks that it belongs to this assembly.
Mesh read_frame_mesh(const std::string& path, const std::string& assembly_hash) {
  Mesh mesh = read_mesh(path);
  const int version = mesh.field<std::int32_t>("format_version");
  if (version < kOldestFrameFormat || version > kFrameFormatVersion)
    throw InputError(
        FileLocation{path},
        fmt::format("has format version {}, this program reads versions {} to {}; run cupola-solve again",
                    version, kOldestFrameFormat, kFrameFormatVersion));
  if (mesh.field<std::string>("assembly_hash") != assembly_hash)
    throw InputError(FileLocation{path}, "belongs to another assembly; run cupola-solve again");
  return mesh;
}

void read_role(const Mesh& mesh, Frame* frame) {
  const auto& role = mesh.field<std::string>("role");
  const std::optional<FrameRole> known = enum_from_name<FrameRole>(role);
  if (!known) throw InputError(FileLocation{mesh.file}, fmt::format("the role `{}` is unknown", role));
  frame->role = *known;
  frame->owner = mesh.field<std::string>("owner");
  frame->label = mesh.field<std::string>("label");
}

ContactTable read_contacts(const Mesh& mesh) {
  ContactTable contacts;
  contacts.point = unflat<Vec3>(mesh.points);
  fields(ArrayReader{mesh, mesh.point_data}, contacts);
  if (contacts.damage.size() != contacts.strength_use.size() ||
      contacts.crack_opening.size() != contacts.strength_use.size())
    throw InputError(FileLocation{mesh.file}, "has some of strength_use, damage and crack_opening_m only");
  return contacts;
}

BlockTable read_blocks(const Mesh& mesh) {
  BlockTable blocks;
  blocks.position = unflat<Vec3>(mesh.points);
  fields(ArrayReader{mesh, mesh.point_data}, blocks);
  return blocks;
}

TieTable read_ties(const Mesh& mesh) {
  TieTable ties;
  fields(ArrayReader{mesh, mesh.cell_data}, ties);
  const std::vector<Vec3> points = unflat<Vec3>(mesh.points);
  if (points.size() != 2 * ties.force.size())
    throw InputError(FileLocation{mesh.file}, "has other than two points per tie");
  for (size_t i = 0; i < points.size(); i += 2) {
    ties.point_a.push_back(points[i]);
    ties.point_b.push_back(points[i + 1]);
  }
  return ties;
}

/// Joint and block numbers are used as indices by later stages: they must be in range.
void check_frame(const Frame& frame, const std::string& path) {
  const int num_blocks = frame.blocks.size();
  for (int i = 0; i < frame.contacts.size(); ++i) {
    const int a = frame.contacts.block_a[i];
    const int b = frame.contacts.block_b[i];
    const int joint = frame.contacts.joint[i];
    if (a < 0 || b <= a || b >= num_blocks || joint < 0 || joint >= frame.contacts.size())
      throw InputError(
          FileLocation{path},
          fmt::format("contact {} between blocks {} and {} of joint {} is invalid", i, a, b, joint));
    if (!frame.contacts.force[i].allFinite() || !frame.contacts.point[i].allFinite())
      throw InputError(FileLocation{path}, fmt::format("contact {} is not finite", i));
  }
  const TieTable& ties = frame.ties;
  for (int i = 0; i < ties.size(); ++i)
    if (ties.block_a[i] < 0 || ties.block_b[i] <= ties.block_a[i] || ties.block_b[i] >= num_blocks ||
        ties.chain[i] < -1 || !std::isfinite(ties.force[i]) || !ties.point_a[i].allFinite() ||
        !ties.point_b[i].allFinite())
      throw InputError(FileLocation{path}, fmt::format("tie {} is invalid", i));
}

constexpr const char* kInterrupted = "interrupted.json";

}  // namespace

ResultsWriter::ResultsWriter(std::string folder, std::string assembly_hash, std::vector<double> times)
    : folder_(std::move(folder)), assembly_hash_(std::move(assembly_hash)), times_(std::move(times)) {
  make_folder(folder_);
  std::filesystem::remove(in_folder(folder_, kInterrupted));
}

void ResultsWriter::write_frame(const Frame& frame) {
  const int index = static_cast<int>(times_.size());
  // The summary and ties of an earlier run would not match the new frames.
  if (index == 0) {
    std::filesystem::remove(in_folder(folder_, "summary.json"));
    std::filesystem::remove(in_folder(folder_, "ties.pvd"));
  }
  times_.push_back(frame.time);
  write_mesh(in_folder(folder_, frame_file("contacts", index)), contacts_mesh(frame, assembly_hash_));
  write_mesh(in_folder(folder_, frame_file("blocks", index)), blocks_mesh(frame, assembly_hash_));
  const auto write_collection = [&](const char* what) {
    std::vector<PvdEntry> entries;
    for (int i = 0; i <= index; ++i)
      if (std::filesystem::exists(in_folder(folder_, frame_file(what, i))))
        entries.push_back({times_[i], frame_file(what, i)});
    write_pvd(in_folder(folder_, fmt::format("{}.pvd", what)), entries);
  };
  write_collection("contacts");
  write_collection("blocks");
  // A stage of construction may come before the first tie; an earlier run may have left its file.
  const std::string ties = in_folder(folder_, frame_file("ties", index));
  std::filesystem::remove(ties);
  if (frame.ties.size() == 0) return;
  write_mesh(ties, ties_mesh(frame, assembly_hash_));
  write_collection("ties");
}

void ResultsWriter::write_text(const std::string& name, const std::string& text) {
  write_text_atomically(in_folder(folder_, name), text);
  text_files_[name] = hash_text(text);
}

void ResultsWriter::write_interruption(const Interruption& interruption) {
  write_text_atomically(in_folder(folder_, kInterrupted), to_json(interruption));
}

void ResultsWriter::write_summary(Summary summary) {
  summary.text_files = text_files_;
  write_text_atomically(in_folder(folder_, "summary.json"), to_json(summary));
}

ResultsReader::ResultsReader(std::string folder, const std::string& assembly_hash, bool force)
    : folder_(std::move(folder)), assembly_hash_(assembly_hash) {
  if (!std::filesystem::is_directory(folder_))
    throw InputError(FileLocation{folder_}, "the results folder does not exist; run cupola-solve first");
  const std::string summary_path = in_folder(folder_, "summary.json");
  if (!std::filesystem::exists(summary_path))
    throw InputError(FileLocation{summary_path},
                     "does not exist: the run has not finished; run or resume cupola-solve");
  summary_ = summary_from_json(read_text(summary_path), summary_path);
  if (force) assembly_hash_ = summary_.assembly_hash;
  if (summary_.assembly_hash != assembly_hash_)
    throw InputError(FileLocation{summary_path},
                     fmt::format("belongs to another assembly (hash {}; the given assembly has {}); "
                                 "run cupola-solve again, or accept it with --force",
                                 summary_.assembly_hash, assembly_hash_));
  for (const PvdEntry& entry : read_pvd(in_folder(folder_, "contacts.pvd"))) times_.push_back(entry.time);
  if (times_.empty()) throw InputError(FileLocation{in_folder(folder_, "contacts.pvd")}, "lists no frames");
}

Frame ResultsReader::read_frame(int index) const {
  const std::string contacts_path = in_folder(folder_, frame_file("contacts", index));
  Frame frame;
  const Mesh contacts = read_frame_mesh(contacts_path, assembly_hash_);
  frame.time = contacts.field<double>("time_s");
  frame.contacts = read_contacts(contacts);
  frame.blocks =
      read_blocks(read_frame_mesh(in_folder(folder_, frame_file("blocks", index)), assembly_hash_));
  const std::string ties_path = in_folder(folder_, frame_file("ties", index));
  if (std::filesystem::exists(ties_path)) frame.ties = read_ties(read_frame_mesh(ties_path, assembly_hash_));
  check_frame(frame, contacts_path);
  if (contacts.field<std::int32_t>("format_version") == kFrameFormatVersion)
    read_role(contacts, &frame);
  else
    set_role_of_old_frame(summary_, index, &frame);
  return frame;
}

std::string ResultsReader::read_text_file(const std::string& name) const {
  const std::string path = in_folder(folder_, name);
  const auto written = summary_.text_files.find(name);
  if (written == summary_.text_files.end())
    throw InputError(FileLocation{path}, "is not listed in summary.json, so it does not belong to this run");
  std::string text = read_text(path);
  if (hash_text(text) != written->second)
    throw InputError(FileLocation{path},
                     "is damaged or was edited: its bytes do not match the hash in summary.json");
  return text;
}

}  // namespace cupola
