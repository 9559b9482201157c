#include "assembly/files/results_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <regex>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/hash.hpp"
#include "assembly/files/mesh_file.hpp"
#include "assembly/files/old_frames.hpp"
#include "assembly/files/record_arrays.hpp"
#include "assembly/files/summary_file.hpp"
#include "assembly/records/frame_record.hpp"

namespace cupola {
namespace {

constexpr std::int32_t kFrameFormatVersion = 3, kOldestFrameFormat = 2;

std::string frame_file(const char* what, int index) {
  return fmt::format("{}_{:04}.vtp", what, index);
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

Mesh frame_mesh(const std::vector<Vec3>& points, const Frame& frame, const RunOfFrame& run) {
  Mesh mesh;
  for (const Vec3& p : points) mesh.add_point(p.x(), p.y(), p.z());
  mesh.field_data = frame_fields(frame, run);
  return mesh;
}

/// Adds one vertex cell per point, so that ParaView shows the points.
Mesh point_mesh(const std::vector<Vec3>& points, const Frame& frame, const RunOfFrame& run) {
  Mesh mesh = frame_mesh(points, frame, run);
  for (int i = 0; i < mesh.num_points(); ++i) mesh.add_cell(Mesh::CellType::vertex, {i});
  return mesh;
}

Mesh contacts_mesh(const Frame& frame, const RunOfFrame& run) {
  Mesh mesh = point_mesh(frame.contacts.point, frame, run);
  const ColumnWriter write{frame.contacts.point.size(), &mesh.point_data};
  fields(write, frame.contacts);
  if (!frame.contacts.strength_use.empty()) strength_fields(write, frame.contacts);
  return mesh;
}

Mesh blocks_mesh(const Frame& frame, const RunOfFrame& run) {
  Mesh mesh = point_mesh(frame.blocks.position, frame, run);
  std::vector<std::int32_t> ids(frame.blocks.position.size());
  std::iota(ids.begin(), ids.end(), 0);
  mesh.point_data = {{"block", 1, std::move(ids)}};
  const ColumnWriter write{frame.blocks.position.size(), &mesh.point_data};
  fields(write, frame.blocks);
  if (!frame.blocks.contact_position.empty()) contact_pose_fields(write, frame.blocks);
  return mesh;
}

/// One segment per tie.
Mesh ties_mesh(const Frame& frame, const RunOfFrame& run) {
  const TieTable& ties = frame.ties;
  CUPOLA_ASSERT(ties.point_a.size() == ties.force.size() && ties.point_b.size() == ties.force.size());
  std::vector<Vec3> ends;
  for (int i = 0; i < ties.size(); ++i) ends.insert(ends.end(), {ties.point_a[i], ties.point_b[i]});
  Mesh mesh = frame_mesh(ends, frame, run);
  for (int i = 0; i < ties.size(); ++i) mesh.add_cell(Mesh::CellType::polyline, {2 * i, 2 * i + 1});
  fields(ColumnWriter{ties.force.size(), &mesh.cell_data}, ties);
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
  ContactTable contacts;
  contacts.point = points_of(mesh);
  const ColumnReader read{contacts.point.size(), mesh, mesh.point_data};
  fields(read, contacts);
  if (!mesh.has(mesh.point_data, "strength_use")) return contacts;
  if (!mesh.has(mesh.point_data, "friction_limit_N"))
    throw InputError(FileLocation{mesh.file},
                     "has no `friction_limit_N`, as of versions before 0.5.2; run cupola-solve again");
  strength_fields(read, contacts);
  return contacts;
}

BlockTable read_blocks(const Mesh& mesh) {
  BlockTable blocks;
  blocks.position = points_of(mesh);
  const ColumnReader read{blocks.position.size(), mesh, mesh.point_data};
  fields(read, blocks);
  if (mesh.has(mesh.point_data, "contact_position_m")) contact_pose_fields(read, blocks);
  return blocks;
}

TieTable read_ties(const Mesh& mesh) {
  TieTable ties;
  const std::vector<Vec3> points = points_of(mesh);
  if (points.size() != 2 * mesh.cell_types.size())
    throw InputError(FileLocation{mesh.file}, "has other than two points per tie");
  fields(ColumnReader{points.size() / 2, mesh, mesh.cell_data}, ties);
  for (size_t i = 0; i < points.size(); i += 2) {
    ties.point_a.push_back(points[i]);
    ties.point_b.push_back(points[i + 1]);
  }
  return ties;
}

/// Joint and block numbers are used as indices by later stages: they must be in range.
void check_contacts(const Frame& frame, const std::string& path) {
  const int num_blocks = frame.blocks.size();
  for (int i = 0; i < frame.contacts.size(); ++i) {
    const int a = frame.contacts.block_a[i];
    const int b = frame.contacts.block_b[i];
    const int joint = frame.contacts.joint[i];
    if (a < 0 || b <= a || b >= num_blocks || joint < 0 || joint >= frame.contacts.size())
      throw InputError(
          FileLocation{path},
          fmt::format("contact {} between blocks {} and {} of joint {} is invalid", i, a, b, joint));
    if (frame.contacts.kind[i] > JointKind::wythe)
      throw InputError(FileLocation{path}, fmt::format("the kind of contact {} is unknown", i));
    if (!frame.contacts.force[i].allFinite() || !frame.contacts.point[i].allFinite())
      throw InputError(FileLocation{path}, fmt::format("contact {} is not finite", i));
  }
}

/// The same of ties. A restraint begins at the first fixed block, whatever the number of the block it holds.
void check_ties(const Frame& frame, const std::string& path) {
  const TieTable& ties = frame.ties;
  const auto is_block = [&frame](int block) { return 0 <= block && block < frame.blocks.size(); };
  for (int i = 0; i < ties.size(); ++i) {
    const int a = ties.block_a[i], b = ties.block_b[i];
    if (!is_block(a) || !is_block(b) || a == b || ties.chain[i] < -1)
      throw InputError(
          FileLocation{path},
          fmt::format("tie {} between blocks {} and {} of chain {} is invalid", i, a, b, ties.chain[i]));
    if (!std::isfinite(ties.force[i]) || !ties.point_a[i].allFinite() || !ties.point_b[i].allFinite())
      throw InputError(FileLocation{path}, fmt::format("tie {} is not finite", i));
  }
}

constexpr const char* kInterrupted = "interrupted.json";
constexpr std::array kTables{"history.csv",         "ranges.csv",   "path.csv",
                             "construction.csv",    "failures.csv", "mechanism_blocks.csv",
                             "mechanism_joints.csv"};

/// Removes what a run writes: readers and scripts would take what an earlier one left for part of this one.
void remove_results(const std::string& folder) {
  std::vector<std::filesystem::path> found;
  for (const auto& file : std::filesystem::directory_iterator(folder))
    if (is_result_file(file.path().filename().string())) found.push_back(file.path());
  for (const std::filesystem::path& path : found) std::filesystem::remove(path);
}

/// Path of a file of a frame that does not exist; "" if both do.
std::string missing_file(const std::string& folder, int index) {
  for (const char* what : {"contacts", "blocks"})
    if (const std::string path = in_folder(folder, frame_file(what, index)); !std::filesystem::exists(path))
      return path;
  return "";
}

/// Names of the files of ties that ties.pvd lists: not every frame has one.
std::set<std::string> listed_ties(const std::string& folder) {
  std::set<std::string> files;
  const std::string path = in_folder(folder, "ties.pvd");
  if (!std::filesystem::exists(path)) return files;
  for (const PvdEntry& entry : read_pvd(path)) files.insert(entry.file);
  return files;
}

/// True if a frame has ties, also where their file was removed.
bool has_ties(const std::string& folder, const std::set<std::string>& listed, int index) {
  const std::string file = frame_file("ties", index);
  return listed.contains(file) || std::filesystem::exists(in_folder(folder, file));
}

void check_frame_is_there(const std::string& folder, int index) {
  if (const std::string missing = missing_file(folder, index); !missing.empty())
    throw SystemError(missing + ": was removed during the run, which therefore stops");
}

}  // namespace

bool is_result_file(const std::string& name) {
  static const std::regex kOfFrames(R"((contacts|blocks|ties)(_\d{4,}\.vtp|\.pvd))");
  return std::ranges::count(kTables, name) > 0 || name == "summary.json" || name == kInterrupted ||
         std::regex_match(name, kOfFrames);
}

ResultsWriter::ResultsWriter(std::string folder, std::string assembly_hash, std::vector<double> times,
                             std::string case_hash)
    : folder_(std::move(folder)),
      assembly_hash_(std::move(assembly_hash)),
      case_hash_(std::move(case_hash)),
      times_(std::move(times)) {
  make_folder(folder_);
  if (times_.empty()) {
    remove_results(folder_);
    return;
  }
  const std::set<std::string> ties = listed_ties(folder_);
  for (int i = 0; i < static_cast<int>(times_.size()); ++i) {
    if (const std::string missing = missing_file(folder_, i); !missing.empty())
      throw InputError(
          FileLocation{missing},
          "was removed, so that the run cannot be resumed; remove the checkpoint to start again");
    if (has_ties(folder_, ties, i)) with_ties_.push_back(i);
  }
  for (const char* name : {kInterrupted, "summary.json"}) std::filesystem::remove(in_folder(folder_, name));
  // A run that is resumed at its end writes no table again.
  for (const std::string name : kTables)
    if (const std::string path = in_folder(folder_, name); std::filesystem::exists(path))
      text_files_[name] = hash_text(read_text(path));
}

void ResultsWriter::write_frame(const Frame& frame) {
  const int index = static_cast<int>(times_.size());
  if (index > 0) {
    check_frame_is_there(folder_, index - 1);
    // Not all, so that the cost of a frame does not grow; two, so that the turn of each comes again.
    for (int turn = 0; turn < 2; ++turn) {
      checked_ = (checked_ + 1) % index;
      check_frame_is_there(folder_, checked_);
    }
  }
  const RunOfFrame run{assembly_hash_, case_hash_};
  write_mesh(in_folder(folder_, frame_file("contacts", index)), contacts_mesh(frame, run));
  write_mesh(in_folder(folder_, frame_file("blocks", index)), blocks_mesh(frame, run));
  // A stage of construction may come before the first tie; a run that was killed may have left its file.
  const std::string ties = in_folder(folder_, frame_file("ties", index));
  std::filesystem::remove(ties);
  if (frame.ties.size() > 0) {
    write_mesh(ties, ties_mesh(frame, run));
    with_ties_.push_back(index);
  }
  times_.push_back(frame.time);
  if (collections_.is_due(times_.size())) write_collections();
}

void ResultsWriter::write_collections() {
  if (collections_.is_current(times_.size())) return;
  const auto write = [this](const char* what, const std::vector<int>& frames) {
    std::vector<PvdEntry> entries;
    for (const int i : frames) entries.push_back({times_[i], frame_file(what, i)});
    if (!entries.empty()) write_pvd(in_folder(folder_, fmt::format("{}.pvd", what)), entries);
  };
  std::vector<int> all(times_.size());
  std::iota(all.begin(), all.end(), 0);
  write("contacts", all);
  write("blocks", all);
  write("ties", with_ties_);
  collections_.written(times_.size());
}

void ResultsWriter::write_text(const std::string& name, const std::string& text) {
  CUPOLA_ASSERT(name == "run.yaml" || is_result_file(name));  // or the next run would not remove it
  write_text_atomically(in_folder(folder_, name), text);
  text_files_[name] = hash_text(text);
}

void ResultsWriter::write_growing(const std::string& name, const std::string& text) {
  if (growing_[name].is_due(text.size())) {
    write_text(name, text);
    growing_[name].written(text.size());
    pending_.erase(name);
  } else {
    pending_[name] = text;
  }
}

void ResultsWriter::finish_tables() {
  for (const auto& [name, text] : pending_) write_text(name, text);
  pending_.clear();
}

void ResultsWriter::write_interruption(const Interruption& interruption) {
  finish_tables();
  write_collections();
  write_text_atomically(in_folder(folder_, kInterrupted), to_json(interruption));
}

void ResultsWriter::write_summary(Summary summary) {
  for (int i = 0; i < static_cast<int>(times_.size()); ++i) check_frame_is_there(folder_, i);
  finish_tables();
  write_collections();
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
  listed_ties_ = listed_ties(folder_);
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
  if (has_ties(folder_, listed_ties_, index)) frame.ties = read_ties(read_frame_mesh(ties_path, run));
  check_contacts(frame, contacts_path);
  check_ties(frame, ties_path);
  if (contacts.field<std::int32_t>("format_version") == kFrameFormatVersion)
    read_role(contacts, &frame);
  else
    set_role_of_old_frame(summary_, index, &frame);
  set_contact_poses_of_old_frame(&frame);
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
