// A results folder with valid checksums and corrupted content: one frame of contacts and blocks.

#include <cmath>

#include "assembly/files/atomic_file.hpp"
#include "assembly/files/results_file.hpp"
#include "tests/fuzz/mesh_edits.hpp"

namespace cupola {
namespace {

Frame small_frame() {
  Frame frame;
  ContactTable& c = frame.contacts;
  for (int i = 0; i < 4; ++i) {
    c.joint.push_back(0);
    c.block_a.push_back(0);
    c.block_b.push_back(1);
    c.kind.push_back(JointKind::base);
    c.ring.push_back(0);
    c.point.emplace_back(i % 2, i / 2, 1.0);
    c.normal.push_back(Vec3::UnitZ());
    c.gap.push_back(0.0);
    c.force.emplace_back(0.0, 0.0, 1.0);
    c.normal_force.push_back(1.0);
    c.friction_use.push_back(0.0);
    c.area.push_back(0.25);
    c.slip.push_back(0.0);
    c.law_violation.push_back(0.0);
  }
  for (int i = 0; i < 2; ++i) {
    frame.blocks.position.emplace_back(0.5, 0.5, i + 0.5);
    frame.blocks.quaternion_wxyz.emplace_back(1.0, 0.0, 0.0, 0.0);
    frame.blocks.velocity.push_back(Vec3::Zero());
    frame.blocks.angular_velocity.push_back(Vec3::Zero());
    frame.blocks.displacement.push_back(Vec3::Zero());
  }
  return frame;
}

}  // namespace

bool reader_accepts(std::string_view bytes) {
  static const ScratchPath scratch("_results");
  const std::string& folder = scratch.path;
  static const bool written = [&] {
    ResultsWriter writer(folder, "hash");
    writer.write_frame(small_frame());
    Summary summary;
    summary.assembly_hash = "hash";
    writer.write_summary(summary);
    return true;
  }();
  static const Mesh good_contacts = read_mesh(folder + "/contacts_0000.vtp");
  static const Mesh good_blocks = read_mesh(folder + "/blocks_0000.vtp");
  demand(written, "the good folder is written");

  ByteSource source(bytes);
  const bool corrupt_blocks = source.take<std::uint8_t>() % 2 == 0;
  Mesh mesh = corrupt_blocks ? good_blocks : good_contacts;
  edit_mesh(source, &mesh);
  write_mesh(folder + (corrupt_blocks ? "/blocks_0000.vtp" : "/contacts_0000.vtp"), mesh);
  write_mesh(folder + (corrupt_blocks ? "/contacts_0000.vtp" : "/blocks_0000.vtp"),
             corrupt_blocks ? good_contacts : good_blocks);
  Frame frame;
  if (!accepts([&] { frame = ResultsReader(folder, "hash").read_frame(0); })) return false;
  for (int i = 0; i < frame.contacts.size(); ++i) {
    const size_t k = static_cast<size_t>(i);
    demand(frame.contacts.block_a[k] >= 0 && frame.contacts.block_b[k] < frame.blocks.size() &&
               frame.contacts.joint[k] >= 0,
           "contacts name blocks and joints");
    demand(frame.contacts.force[k].allFinite() && frame.contacts.point[k].allFinite(), "contacts are finite");
  }
  return true;
}

}  // namespace cupola
