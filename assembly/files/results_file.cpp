#include "assembly/files/results_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/hash.hpp"
#include "assembly/files/mesh_file.hpp"
#include "assembly/files/old_frames.hpp"
#include "assembly/files/summary_file.hpp"

namespace cupola {
namespace {

constexpr std::int32_t kFrameFormatVersion = 3, kOldestFrameFormat = 2;

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

/// What every file of a frame says about its run.
struct RunOfFrame {
  const std::string &assembly_hash, &case_hash;
};

std::vector<MeshArray> frame_fields(const Frame& frame, const RunOfFrame& run) {
  std::vector<MeshArray> fields = {{"format_version", 1, std::vector<std::int32_t>{kFrameFormatVersion}},
                                   {"program_version", 1, std::vector<std::string>{program_version()}},
                                   {"assembly_hash", 1, std::vector<std::string>{run.assembly_hash}},
                                   {"time_s", 1, std::vector<double>{frame.time}},
                                   {"role", 1, std::vector<std::string>{to_string(frame.role)}},
                                   {"owner", 1, std::vector<std::string>{frame.owner}},
                                   {"label", 1, std::vector<std::string>{frame.label}}};
  if (!run.case_hash.empty()) fields.push_back({"case_hash", 1, std::vector<std::string>{run.case_hash}});
  return fields;
}

/// Adds one vertex cell per point, so that ParaView shows the points.
Mesh point_mesh(const std::vector<Vec3>& points, const Frame& frame, const RunOfFrame& run) {
  Mesh mesh;
  mesh.points = flat(points);
  for (int i = 0; i < mesh.num_points(); ++i) mesh.add_cell(Mesh::CellType::vertex, {i});
  mesh.field_data = frame_fields(frame, run);
  return mesh;
}

Mesh contacts_mesh(const Frame& frame, const RunOfFrame& run) {
  const ContactTable& c = frame.contacts;
  [[maybe_unused]] const std::size_t n = c.joint.size();
  CUPOLA_ASSERT(c.block_a.size() == n && c.block_b.size() == n && c.kind.size() == n && c.ring.size() == n &&
                c.point.size() == n && c.normal.size() == n && c.gap.size() == n && c.force.size() == n &&
                c.normal_force.size() == n && c.friction_use.size() == n && c.area.size() == n &&
                c.slip.size() == n && c.law_violation.size() == n &&
                (c.strength_use.empty() || c.strength_use.size() == n) &&
                c.damage.size() == c.strength_use.size() && c.crack_opening.size() == c.strength_use.size());
  Mesh mesh = point_mesh(c.point, frame, run);
  std::vector<std::uint8_t> kinds;
  for (const JointKind kind : c.kind) kinds.push_back(static_cast<std::uint8_t>(kind));
  mesh.point_data = {{"joint", 1, c.joint},
                     {"block_a", 1, c.block_a},
                     {"block_b", 1, c.block_b},
                     {"kind", 1, std::move(kinds)},
                     {"ring", 1, c.ring},
                     {"normal", 3, flat(c.normal)},
                     {"gap_m", 1, c.gap},
                     {"force_N", 3, flat(c.force)},
                     {"normal_force_N", 1, c.normal_force},
                     {"friction_use", 1, c.friction_use},
                     {"area_m2", 1, c.area},
                     {"slip_m", 1, c.slip},
                     {"law_violation", 1, c.law_violation}};
  if (!c.strength_use.empty()) {
    mesh.point_data.push_back({"strength_use", 1, c.strength_use});
    mesh.point_data.push_back({"damage", 1, c.damage});
    mesh.point_data.push_back({"crack_opening_m", 1, c.crack_opening});
  }
  return mesh;
}

Mesh blocks_mesh(const Frame& frame, const RunOfFrame& run) {
  const BlockTable& b = frame.blocks;
  const std::size_t n = b.position.size();
  CUPOLA_ASSERT(b.quaternion_wxyz.size() == n && b.velocity.size() == n && b.angular_velocity.size() == n &&
                b.displacement.size() == n);
  Mesh mesh = point_mesh(b.position, frame, run);
  std::vector<std::int32_t> ids(n);
  for (size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int32_t>(i);
  mesh.point_data = {{"block", 1, std::move(ids)},
                     {"quaternion_wxyz", 4, flat(b.quaternion_wxyz)},
                     {"velocity_m_per_s", 3, flat(b.velocity)},
                     {"angular_velocity_rad_per_s", 3, flat(b.angular_velocity)},
                     {"displacement_m", 3, flat(b.displacement)}};
  return mesh;
}

/// One segment per tie.
Mesh ties_mesh(const Frame& frame, const RunOfFrame& run) {
  const TieTable& t = frame.ties;
  [[maybe_unused]] const std::size_t n = t.force.size();
  CUPOLA_ASSERT(t.chain.size() == n && t.block_a.size() == n && t.block_b.size() == n &&
                t.point_a.size() == n && t.point_b.size() == n && t.yield_force.size() == n &&
                t.yielded.size() == n && t.strut.size() == n);
  Mesh mesh;
  mesh.field_data = frame_fields(frame, run);
  for (int i = 0; i < t.size(); ++i) {
    const int a = mesh.add_point(t.point_a[i].x(), t.point_a[i].y(), t.point_a[i].z());
    const int b = mesh.add_point(t.point_b[i].x(), t.point_b[i].y(), t.point_b[i].z());
    mesh.add_cell(Mesh::CellType::polyline, {a, b});
  }
  mesh.cell_data = {{"chain", 1, t.chain},   {"block_a", 1, t.block_a},           {"block_b", 1, t.block_b},
                    {"force_N", 1, t.force}, {"yield_force_N", 1, t.yield_force}, {"yielded_m", 1, t.yielded},
                    {"strut", 1, t.strut}};
  return mesh;
}

/// Reads a file of a frame and checks that it belongs to this assembly and run.
Mesh read_frame_mesh(const std::string& path, const RunOfFrame& run) {
  Mesh mesh = read_mesh(path);
  const int version = mesh.field<std::int32_t>("format_version");
  if (version < kOldestFrameFormat || version > kFrameFormatVersion)
    throw InputError(
        FileLocation{path},
        fmt::format("has format version {}, this program reads versions {} to {}; run cupola-solve again",
                    version, kOldestFrameFormat, kFrameFormatVersion));
  if (mesh.field<std::string>("assembly_hash") != run.assembly_hash)
    throw InputError(FileLocation{path}, "belongs to another assembly; run cupola-solve again");
  // Frames of version 0.2, and of a writer without a case, do not name it.
  if (mesh.has(mesh.field_data, "case_hash") && mesh.field<std::string>("case_hash") != run.case_hash)
    throw InputError(FileLocation{path}, "belongs to another run than summary.json; run cupola-solve again");
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
  const auto ints = [&mesh](const char* name) { return mesh.array<std::int32_t>(mesh.point_data, name, 1); };
  const auto doubles = [&mesh](const char* name) { return mesh.array<double>(mesh.point_data, name, 1); };
  const auto vectors = [&mesh](const char* name) {
    return unflat<Vec3>(mesh.array<double>(mesh.point_data, name, 3));
  };
  ContactTable c;
  c.joint = ints("joint");
  c.block_a = ints("block_a");
  c.block_b = ints("block_b");
  for (const std::uint8_t kind : mesh.array<std::uint8_t>(mesh.point_data, "kind", 1)) {
    if (kind > static_cast<std::uint8_t>(JointKind::wythe))
      throw InputError(FileLocation{mesh.file}, fmt::format("joint kind {} is unknown", kind));
    c.kind.push_back(static_cast<JointKind>(kind));
  }
  c.ring = ints("ring");
  c.point = unflat<Vec3>(mesh.points);
  c.normal = vectors("normal");
  c.gap = doubles("gap_m");
  c.force = vectors("force_N");
  c.normal_force = doubles("normal_force_N");
  c.friction_use = doubles("friction_use");
  c.area = doubles("area_m2");
  c.slip = doubles("slip_m");
  c.law_violation = doubles("law_violation");
  if (!mesh.has(mesh.point_data, "strength_use")) return c;
  c.strength_use = doubles("strength_use");
  c.damage = doubles("damage");
  c.crack_opening = doubles("crack_opening_m");
  return c;
}

BlockTable read_blocks(const Mesh& mesh) {
  const auto vectors = [&mesh](const char* name) {
    return unflat<Vec3>(mesh.array<double>(mesh.point_data, name, 3));
  };
  BlockTable b;
  b.position = unflat<Vec3>(mesh.points);
  b.quaternion_wxyz = unflat<Eigen::Vector4d>(mesh.array<double>(mesh.point_data, "quaternion_wxyz", 4));
  b.velocity = vectors("velocity_m_per_s");
  b.angular_velocity = vectors("angular_velocity_rad_per_s");
  b.displacement = vectors("displacement_m");
  return b;
}

TieTable read_ties(const Mesh& mesh) {
  TieTable t;
  t.chain = mesh.array<std::int32_t>(mesh.cell_data, "chain", 1);
  t.block_a = mesh.array<std::int32_t>(mesh.cell_data, "block_a", 1);
  t.block_b = mesh.array<std::int32_t>(mesh.cell_data, "block_b", 1);
  t.force = mesh.array<double>(mesh.cell_data, "force_N", 1);
  t.yield_force = mesh.array<double>(mesh.cell_data, "yield_force_N", 1);
  t.yielded = mesh.array<double>(mesh.cell_data, "yielded_m", 1);
  t.strut = mesh.array<std::uint8_t>(mesh.cell_data, "strut", 1);
  const std::vector<Vec3> points = unflat<Vec3>(mesh.points);
  if (points.size() != 2 * t.force.size())
    throw InputError(FileLocation{mesh.file}, "has other than two points per tie");
  for (size_t i = 0; i < points.size(); i += 2) {
    t.point_a.push_back(points[i]);
    t.point_b.push_back(points[i + 1]);
  }
  return t;
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

/// Path of a file of a frame that does not exist; "" if both do.
std::string missing_file(const std::string& folder, int index) {
  for (const char* what : {"contacts", "blocks"})
    if (const std::string path = in_folder(folder, frame_file(what, index)); !std::filesystem::exists(path))
      return path;
  return "";
}

}  // namespace

ResultsWriter::ResultsWriter(std::string folder, std::string assembly_hash, std::vector<double> times,
                             std::string case_hash)
    : folder_(std::move(folder)),
      assembly_hash_(std::move(assembly_hash)),
      case_hash_(std::move(case_hash)),
      times_(std::move(times)) {
  make_folder(folder_);
  for (int i = 0; i < static_cast<int>(times_.size()); ++i)
    if (const std::string missing = missing_file(folder_, i); !missing.empty())
      throw InputError(
          FileLocation{missing},
          "was removed, so that the run cannot be resumed; remove the checkpoint to start again");
  std::filesystem::remove(in_folder(folder_, kInterrupted));
}

void ResultsWriter::write_frame(const Frame& frame) {
  const int index = static_cast<int>(times_.size());
  // The summary and ties of an earlier run would not match the new frames.
  if (index == 0) {
    std::filesystem::remove(in_folder(folder_, "summary.json"));
    std::filesystem::remove(in_folder(folder_, "ties.pvd"));
  }
  for (int i = 0; i < index; ++i)
    if (const std::string missing = missing_file(folder_, i); !missing.empty())
      throw SystemError(missing + ": was removed during the run, which therefore stops");
  times_.push_back(frame.time);
  const RunOfFrame run{assembly_hash_, case_hash_};
  write_mesh(in_folder(folder_, frame_file("contacts", index)), contacts_mesh(frame, run));
  write_mesh(in_folder(folder_, frame_file("blocks", index)), blocks_mesh(frame, run));
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
  write_mesh(ties, ties_mesh(frame, run));
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
  if (!std::filesystem::exists(in_folder(folder_, "contacts.pvd")))
    throw InputError(FileLocation{summary_path},
                     fmt::format("the run found no state that could be evaluated: {}", summary_.message));
  for (const PvdEntry& entry : read_pvd(in_folder(folder_, "contacts.pvd"))) times_.push_back(entry.time);
  if (times_.empty()) throw InputError(FileLocation{in_folder(folder_, "contacts.pvd")}, "lists no frames");
}

Frame ResultsReader::read_frame(int index) const {
  const std::string contacts_path = in_folder(folder_, frame_file("contacts", index));
  const RunOfFrame run{assembly_hash_, summary_.case_hash};
  Frame frame;
  const Mesh contacts = read_frame_mesh(contacts_path, run);
  frame.time = contacts.field<double>("time_s");
  frame.contacts = read_contacts(contacts);
  frame.blocks = read_blocks(read_frame_mesh(in_folder(folder_, frame_file("blocks", index)), run));
  const std::string ties_path = in_folder(folder_, frame_file("ties", index));
  if (std::filesystem::exists(ties_path)) frame.ties = read_ties(read_frame_mesh(ties_path, run));
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
