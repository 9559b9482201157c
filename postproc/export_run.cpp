#include "postproc/export_run.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/export/export.hpp"
#include "assembly/export/placed_assembly.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/program/warnings.hpp"
#include "postproc/mechanics/stage_blocks.hpp"
#include "postproc/tables/mesh_parts.hpp"
#include "postproc/tables/result_tables.hpp"

namespace cupola {
namespace {

ExportedJoint exported(const JointWrench& joint, const JointWrenches& joints, const ContactTable& contacts) {
  ExportedJoint out;
  static_cast<Joint&>(out) = joint;
  out.normal = joint.patch.plane.normal;
  for (const Eigen::Vector2d& corner : joint.patch.outline)
    out.outline.push_back(joint.patch.position(corner));
  out.area = joint.area;
  out.centre = joint.centre_of_pressure;
  if (!joint.negligible) out.force = joint.wrench.force;
  for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
    out.points.push_back(contacts.point[joints.contacts[i]]);
    out.forces.push_back(contacts.force[joints.contacts[i]]);
  }
  return out;
}

bool have_compressive_strength(const Joints& joints) {
  const auto has = [](const JointLawChange& law) { return law.compressive_strength.has_value(); };
  return joints.strength.compression != JointStrength{}.compression ||
         std::ranges::any_of(joints.kinds(), [&](const auto& kind) { return has(*kind.second); }) ||
         std::ranges::any_of(joints.rings, [&](const RingJoints& group) { return has(group.law); });
}

/// What an assembly cannot hold of the joints of a run, of one that `moves` also what it crushed; empty if
/// nothing is lost.
std::string lost_of_joints(const ContactTable& contacts, const Joints& joints, bool moves) {
  double damage = 0.0;
  for (const double of_point : contacts.damage) damage = std::fmax(damage, of_point);
  const bool may_be_crushed = moves && have_compressive_strength(joints);
  if (damage == 0.0 && !may_be_crushed) return "";
  return fmt::format(
      "joints are exported as new, without their damage (up to {:.2g}){}: other analyses of the export may "
      "let them bear too much",
      damage, may_be_crushed ? " and crushing" : "");
}

}  // namespace

ExitCode export_run(const RunInput& input, const std::string& path, bool quiet) {
  check_export_path(path);
  check_output_file(path);
  const EvaluatedRun run = evaluate_run(input);
  const Evaluation& e = run.evaluation;
  std::vector<std::string> warnings = e.warnings;
  const FrameRole role = e.last.frame.role;
  std::ranges::move(lost_by_export(path, e.assembly), std::back_inserter(warnings));
  const bool moves = role == FrameRole::step || role == FrameRole::path;
  if (is_stage(role))
    if (const auto missing = std::ranges::count(laid_blocks(e.assembly, e.last.frame), false); missing > 0)
      warnings.push_back(
          fmt::format("{} that the last stage has not laid were exported, too", counted(missing, "block")));
  ExportModel model{e.assembly, {}, {}, common_scale(e)};
  if (moves) {
    model.poses = poses_of(e.assembly, e.last.frame.blocks);
    model.yielded = yielded_of(e.assembly, e.last.frame.ties, e.scene.ties.pairs.size());
  }
  const bool is_table = path.ends_with(".csv");  // of joints, with their damage
  if (std::string lost = lost_of_joints(e.last.frame.contacts, e.scene.joints, moves);
      !lost.empty() && !is_table)
    warnings.push_back(std::move(lost));
  if (at_rest(e))
    for (const JointWrench& joint : e.last.joints.wrenches)
      model.joints.push_back(exported(joint, e.last.joints, e.last.frame.contacts));
  else
    warnings.emplace_back("no equilibrium was found, therefore no forces were exported");
  if (is_table)
    write_text_atomically(path, to_csv(joint_table(e, e.last.joints.wrenches)));
  else
    write_export(path, model);
  report_warnings("cupola-post", warnings, run.doubts, false);
  if (!quiet)
    fmt::print("{}, {}: {}\n", counted(e.assembly.blocks.size(), "block"),
               counted(e.last.joints.wrenches.size(), "joint"), path);
  return ExitCode::done;
}

}  // namespace cupola
