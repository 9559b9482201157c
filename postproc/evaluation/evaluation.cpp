#include "postproc/evaluation/evaluation.hpp"

#include <algorithm>
#include <functional>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/case/limit_parameter.hpp"
#include "assembly/export/placed_assembly.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/model/thickness.hpp"
#include "postproc/evaluation/meridians.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/evaluation/sections.hpp"
#include "postproc/mechanics/plane_contacts.hpp"
#include "postproc/mechanics/stage_blocks.hpp"

namespace cupola {
namespace {

/// Blocks belong to one body of a mechanism if their joint moves by less than this share of the largest
/// displacement.
constexpr double kGroupShare = 0.02;

double largest_norm(const std::vector<Vec3>& vectors) {
  double largest = 0.0;
  for (const Vec3& v : vectors) largest = std::max(largest, v.norm());
  return largest;
}

void check_blocks(const Frame& frame, const Assembly& assembly) {
  if (frame.blocks.position.size() != assembly.blocks.size())
    throw InputError(fmt::format("the results hold {} and the assembly {}: solve this assembly again",
                                 counted(frame.blocks.size(), "block"), assembly.blocks.size()));
}

void check_joints(const std::vector<ForceRange>& ranges, const Assembly& assembly) {
  const auto exists = [&](int block) {
    return block >= 0 && block < static_cast<int>(assembly.blocks.size());
  };
  for (const ForceRange& range : ranges)
    if (range.joint && !(exists(range.joint->first) && exists(range.joint->second)))
      throw InputError(
          fmt::format("the results hold a range of joint {}-{}, and the assembly {}: solve this "
                      "assembly again",
                      range.joint->first, range.joint->second, counted(assembly.blocks.size(), "block")));
}

/// Displaces blocks along their velocities until the fastest has moved by `share` times the size of the model.
BlockTable displaced(const Assembly& assembly, double share, BlockTable blocks) {
  const double fastest = largest_norm(blocks.velocity);
  if (fastest == 0.0) return blocks;
  const double time = share * model_size(assembly) / fastest;
  for (size_t b = 0; b < blocks.position.size(); ++b) {
    const Vec3 turn = time * blocks.angular_velocity[b];
    const Eigen::Quaterniond q(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()));
    blocks.position[b] += time * blocks.velocity[b];
    blocks.displacement[b] += time * blocks.velocity[b];
    blocks.quaternion_wxyz[b] = Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
  }
  return blocks;
}

/// The groups of blocks that move as one body. Those of a mechanism follow from a displacement so small that
/// a turn, whose centroids move along straight lines, parts no body.
std::vector<int> groups_of(const Assembly& assembly, const Frame& frame, const JointWrenches& joints) {
  constexpr double kSlight = 1e-6;
  const BlockTable moved =
      is_mechanism(frame.role) ? displaced(assembly, kSlight, frame.blocks) : frame.blocks;
  return mechanism_groups(assembly, poses_of(assembly, moved), joints,
                          kGroupShare * largest_norm(moved.displacement));
}

/// Takes the motion of the ground out of a frame, so that its points are where the masonry was built. That of
/// the contacts and ties, some way before the end of the step, is that of a support.
void bring_back_to_site(const Assembly& assembly, Frame* frame) {
  BlockTable& blocks = frame->blocks;
  // Positions have the motion of the ground, displacements do not.
  const Vec3 ground = blocks.position[0] - assembly.blocks[0].centroid - blocks.displacement[0];
  for (Vec3& x : blocks.position) x -= ground;
  if (blocks.contact_position.empty()) return;
  const auto support = std::ranges::find_if(assembly.blocks, &Block::fixed);
  const size_t b = support == assembly.blocks.end() ? 0 : support - assembly.blocks.begin();
  const Vec3 then = blocks.contact_position[b] - assembly.blocks[b].centroid - blocks.displacement[b];
  for (std::vector<Vec3>* points :
       {&blocks.contact_position, &frame->contacts.point, &frame->ties.point_a, &frame->ties.point_b})
    for (Vec3& x : *points) x -= then;
}

std::string frame_name(int index) {
  return fmt::format("frame {}", index);
}

/// The first frame if it is an equilibrium, which a mechanism or the ends of ranges follow; else the last
/// that can be read.
Frame evaluated_frame(const ResultsReader& results, Evaluation* e) {
  e->last_frame = 0;
  try {
    Frame first = results.read_frame(0);
    if (results.times().size() == 1 || first.role == FrameRole::equilibrium) return first;
  } catch (const InputError& error) {
    if (results.times().size() == 1) throw;
    leave_out(frame_name(0), error.what(), e);
  }
  for (e->last_frame = static_cast<int>(results.times().size()) - 1;; --e->last_frame) {
    try {
      return results.read_frame(e->last_frame);
    } catch (const InputError& error) {
      if (e->last_frame == 0) throw;
      leave_out(frame_name(e->last_frame), error.what(), e);
    }
  }
}

void add_status_warnings(Evaluation* e) {
  const FrameRole shown = e->last.frame.role;
  const auto warn = [e](const char* text) { e->warnings.emplace_back(text); };
  if (at_rest(*e) && !e->summary.parts.empty()) return;  // the verdict says what does not stand
  if (e->summary.status == Status::unconverged && !e->summary.ranges.empty())
    warn("not all ends of the ranges were found to the requested accuracy");
  else if (e->summary.status == Status::bracketed ||
           (e->summary.status == Status::unconverged &&
            (shown == FrameRole::equilibrium || shown == FrameRole::mechanism)))
    warn(e->summary.critical ? "the critical value was not bracketed to the requested width"
                             : "no critical value was found");
  else if (e->summary.status == Status::unconverged)
    warn("the solver did not reach the requested accuracy: do not use its forces");
  else if (!at_rest(*e) && e->summary.analysis == AnalysisType::range)
    warn("the structure moves: there is no admissible state of which ranges could be found");
}

/// Pairs of blocks that pressed on each other in `first` and do not touch any more.
int joints_lost_since(const ContactTable& first, const JointWrenches& last) {
  std::set<std::pair<int, int>> touching, lost;
  for (const JointWrench& joint : last.wrenches)
    if (joint.touches) touching.emplace(joint.block_a, joint.block_b);
  for (int i = 0; i < first.size(); ++i)
    if (first.normal_force[i] > 0.0 && !touching.contains({first.block_a[i], first.block_b[i]}))
      lost.emplace(first.block_a[i], first.block_b[i]);
  return static_cast<int>(lost.size());
}

void count_lost_joints(const ResultsReader& results, Evaluation* e) {
  e->lost_joints = 0;
  if (e->times.size() < 2 || e->last.frame.role != FrameRole::step) return;
  try {
    e->lost_joints = joints_lost_since(results.read_frame(0).contacts, e->last.joints);
  } catch (const InputError& error) {
    e->lost_joints.reset();
    leave_out(frame_name(0), error.what(), e);
  }
  if (e->lost_joints.value_or(0) > 0 && at_rest(*e))  // of a collapse it is no surprise
    e->warnings.push_back(
        fmt::format("{} that carried force in the first frame separated completely before the last",
                    counted(*e->lost_joints, "joint")));
}

/// Fill that presses harder from the side than a vault pushes back holds it up.
void warn_of_props(Evaluation* e) {
  const bool presses = std::ranges::any_of(
      e->scene.loads.faces, [](const FaceLoad& load) { return load.fill && load.fill->horizontal > 0.0; });
  if (!presses || !at_rest(*e) || e->summary.critical || !e->summary.ranges.empty() || e->rings.empty())
    return;
  for (const Sheet& sheet : e->assembly.sheets) {
    const double thrust = e->rings.at(e->assembly.stack_of(sheet.first_ring).first).radial_thrust;
    if (sheet.thrust_lines == Sheet::ThrustLines::none || thrust >= 0.0) continue;
    e->warnings.push_back(fmt::format(
        "{} pushes inwards with {}: the horizontal pressure of the fill holds it, and must come from a real "
        "mass behind the fill; does it stand with `horizontal: 0`?",
        sheet.name, force_text(-thrust)));
    return;
  }
}

/// N, force that an equilibrium leaves unbalanced on a block.
double unbalanced_force(const Evaluation& e) {
  const Summary& s = e.summary;
  if (!at_rest(e) || s.free_blocks == 0) return 0.0;
  return s.equilibrium_residual.value_or(0.0) * s.weight_N / s.free_blocks;
}

/// The motion of a mechanism: of the frame evaluated, or of that which follows the equilibrium of a limit.
/// Stages move in many ways: their table says how each does.
void find_what_gives_way(const ResultsReader& results, Evaluation* e) {
  if (e->last.frame.role == FrameRole::mechanism)
    e->gives_way = mechanism_motion(e->assembly, e->last.frame, e->last.joints);
  if (!e->summary.critical || e->times.size() < 2) return;
  try {
    Frame frame = results.read_frame(1);
    if (e->scene.analysis.plane) spread_across_plane(&frame.contacts);
    if (frame.role == FrameRole::mechanism)
      e->gives_way =
          mechanism_motion(e->assembly, frame, joint_wrenches(e->assembly, frame.contacts, e->shell));
  } catch (const InputError& error) {
    leave_out(frame_name(1), error.what(), e);
  }
}

/// Sets loads and thickness to those of the equilibrium evaluated.
void apply_limit(Evaluation* e) {
  e->acting = e->scene.loads;
  if (!e->summary.critical || is_stage(e->last.frame.role)) return;
  const double value = e->summary.critical->stable;
  e->acting = case_at(e->scene, value).loads;
  if (e->scene.analysis.limit.parameter == LimitSearch::Parameter::thickness)
    e->assembly = with_thickness(e->assembly, value);
}

/// Of an equilibrium of some parts: blocks of the others.
std::vector<bool> beside_standing_parts(const Evaluation& e, const FrameEvaluation& shown) {
  std::vector<bool> left_out(e.assembly.blocks.size(), true);
  const std::vector<int> part_of = connected_parts(e.assembly, shown.joints, shown.frame.ties);
  for (const PartVerdict& part : e.summary.parts)
    for (size_t b = 0; b < left_out.size() && stands(part.status); ++b)
      if (part_of[b] == part_of[part.first_block]) left_out[b] = false;
  return left_out;
}

/// Per block, true if a frame leaves it out; empty if it has all.
std::vector<bool> left_out_of(const Evaluation& e, const FrameEvaluation& shown) {
  if (shown.frame.role == FrameRole::equilibrium && !e.summary.parts.empty())
    return beside_standing_parts(e, shown);
  return blocks_left_out(e.assembly, shown.frame, e.scene.analysis.staged.hold_below);
}

/// Loads on blocks that a frame leaves out. A stage bears loads other than weight once all blocks are laid.
void leave_out_loads(const Evaluation& e, FrameEvaluation* shown) {
  const std::vector<bool> left_out = left_out_of(e, *shown);
  const bool complete = !is_stage(shown->frame.role) ||
                        std::ranges::all_of(laid_blocks(e.assembly, shown->frame), std::identity{});
  std::erase_if(shown->loads, [&](const PointForce& load) {
    return !complete || (!left_out.empty() && left_out[load.block]);
  });
}

void evaluate_cuts(const std::vector<bool>& left_out, Evaluation* e) {
  const Postproc& asked = e->scene.postproc;
  if (asked.sections.empty() && asked.planes.empty()) return;
  const Assembly placed = placed_assembly({e->assembly, e->last.poses.of_block, {}});
  e->sections = evaluate_sections(*e, placed, left_out);
  for (const CutPlane& plane : asked.planes) {
    PlaneCut cut = plane_cut(plane, e->assembly, e->last.joints, e->last.gravity, e->last.loads,
                             e->last.frame.ties, left_out);
    cut.polygons = cut_by_plane(placed, {cut.normal, cut.normal.dot(cut.point)}, left_out);
    e->planes.push_back(std::move(cut));
  }
}

}  // namespace

bool is_limit(const Evaluation& e) {
  return e.summary.analysis == AnalysisType::limit;
}

bool has_scaled_joints(const Evaluation& e) {
  return e.summary.critical && e.summary.critical->parameter == "joint_extent";
}

std::string of_extent(const Evaluation& e) {
  return has_scaled_joints(e) ? fmt::format(", of {:.4g} times their extent", e.summary.critical->stable)
                              : "";
}

bool is_rigid(const Evaluation& e) {
  return is_limit(e) || !e.summary.ranges.empty();
}

bool has_default_stiffness(const Evaluation& e) {
  return e.scene.joints.compliance.relative == Compliance::kRelative;
}

bool supports_have_not_moved(const Evaluation& e) {
  return e.last.frame.role == FrameRole::equilibrium &&
         std::ranges::any_of(e.scene.supports.moves, [](const SupportMove& move) {
           return varies(move.time) && factor_at(move.time, 0.0) == 0.0;
         });
}

bool at_rest(const Evaluation& e) {
  switch (e.last.frame.role) {
    case FrameRole::equilibrium:
    case FrameRole::path:
    case FrameRole::range_end:
      return true;
    case FrameRole::step:
    case FrameRole::stage:
      return stands(e.summary.status);
    case FrameRole::failed_stage:
    case FrameRole::mechanism:
    case FrameRole::self_stress:
    case FrameRole::unconverged:
      break;
  }
  return false;
}

bool is_vault(const Evaluation& e) {
  return e.shell.num_rings() > 0 && !e.assembly.sheets.empty() &&
         e.assembly.sheets.back().thrust_lines == Sheet::ThrustLines::by_azimuth &&
         e.assembly.sheets.back().is_central();
}

bool is_arch(const Evaluation& e) {
  return e.shell.num_rings() > 0 && !e.assembly.sheets.empty() &&
         e.assembly.sheets.back().thrust_lines == Sheet::ThrustLines::one;
}

void leave_out(const std::string& part, const std::string& reason, Evaluation* e) {
  std::string text = fmt::format("{} was left out: {}", part, reason);
  if (std::find(e->unreadable.begin(), e->unreadable.end(), text) == e->unreadable.end())
    e->unreadable.push_back(std::move(text));
}

std::vector<std::string> notices(const Evaluation& e) {
  std::vector<std::string> all = e.unreadable;
  all.insert(all.end(), e.warnings.begin(), e.warnings.end());
  return all;
}

void set_loads(const Evaluation& e, double time, FrameEvaluation* shown) {
  shown->gravity = factor_at(e.acting.dead_load_time, time) * e.acting.gravity + e.acting.pull;
  const std::vector<TimeFunction> times = load_times(e.acting);
  shown->loads = e.loads;
  for (PointForce& load : shown->loads)
    load.force *= load_factor(load.time, e.acting.dead_load_time, times, time);
}

FrameEvaluation evaluate_frame(const Evaluation& e, Frame frame) {
  check_blocks(frame, e.assembly);
  FrameEvaluation out;
  out.frame = std::move(frame);
  const bool follows = out.frame.role == FrameRole::step || out.frame.role == FrameRole::path;
  if (follows && e.scene.supports.base_motion) bring_back_to_site(e.assembly, &out.frame);
  if (e.scene.analysis.plane) spread_across_plane(&out.frame.contacts);
  const bool mechanism = is_mechanism(out.frame.role);
  out.poses.of_block = contact_poses_of(e.assembly, out.frame.blocks);
  out.joints = joint_wrenches(e.assembly, out.frame.contacts, e.shell, unbalanced_force(e));
  if (out.frame.role != FrameRole::self_stress) {
    // The time of an end of a range is its number, that of a stage its course: they bear what acts at time 0.
    const bool timeless = out.frame.role == FrameRole::range_end || is_stage(out.frame.role);
    const double time = timeless ? 0.0 : out.frame.time;
    set_loads(e, time, &out);
    leave_out_loads(e, &out);
  }
  out.from_below = wrenches_from_below(e.assembly, out.joints, out.poses);
  out.fields = block_fields(e.assembly, out.frame, out.joints, out.from_below, out.loads, e.axes, out.poses);
  if (at_rest(e) && !mechanism)
    out.groups.assign(e.assembly.blocks.size(), 0);
  else
    out.groups = groups_of(e.assembly, out.frame, out.joints);
  constexpr double kShown = 0.025;
  if (mechanism) out.frame.blocks = displaced(e.assembly, kShown, std::move(out.frame.blocks));
  return out;
}

Evaluation evaluate(const Case& scene, Assembly assembly, const ResultsReader& results,
                    const std::vector<std::string>& doubts) {
  Evaluation e;
  e.scene = scene;
  e.assembly = std::move(assembly);
  e.summary = results.summary();
  check_joints(e.summary.ranges, e.assembly);
  e.times = results.times();
  if (scene.loads.gravity.norm() > 0.0) e.up = -scene.loads.gravity.normalized();
  Frame shown = evaluated_frame(results, &e);
  e.last.frame.role = shown.role;  // at_rest() asks for it
  add_status_warnings(&e);
  if (e.summary.geometry_hash != scene.geometry_hash || e.assembly.geometry_hash != scene.geometry_hash)
    e.warnings.push_back(
        "the geometry of the case has changed since the assembly was generated or solved: generate and solve "
        "it again");
  else if (e.summary.case_hash != scene.hash)
    e.warnings.push_back(
        "the case has changed since it was solved: its loads, joints or analysis may differ");
  if (e.summary.assembly_hash != content_hash(e.assembly))
    e.warnings.push_back("the results belong to another assembly: the drawings may not match them");

  apply_limit(&e);
  e.loads = applied_loads(e.acting, e.assembly);
  e.shell = shell_of(e.assembly, e.up);
  e.axes = shell_axes(e.assembly, e.shell);
  e.last = evaluate_frame(e, std::move(shown));
  const std::vector<bool> left_out = left_out_of(e, e.last);
  e.rings = ring_sums(e.assembly, e.shell, e.last.joints, e.last.from_below, e.last.gravity, e.last.loads,
                      e.last.frame.ties, left_out);
  warn_of_props(&e);
  e.joint_cracks = cracks_of(e.last.frame.contacts, e.last.joints);
  if (at_rest(e)) e.cracks = shell_cracks(e.assembly, e.last.frame.contacts, e.last.joints, e.axes);
  const TieTable& ties = e.last.frame.ties;
  e.reactions = support_reactions(e.assembly, e.last.joints, e.shell, ties,
                                  num_ties_of(ties, scene.supports.restraints));
  if (has_scaled_joints(e))  // not as long as the supports
    for (Reaction& r : e.reactions) r.length = std::numeric_limits<double>::quiet_NaN();
  e.parts = connected_parts(e.assembly, e.last.joints, ties);
  find_what_gives_way(results, &e);
  e.chains = chain_forces(e.assembly.chains, e.last.frame.ties);
  e.wythes = wythe_sums(e.assembly, e.shell, e.last.joints, e.last.frame.contacts, e.last.poses);
  e.members = member_sums(e.assembly, e.last.joints, scene.loads.gravity, left_out);
  count_lost_joints(results, &e);
  const bool has_lines = std::ranges::any_of(
      e.assembly.sheets, [](const Sheet& sheet) { return sheet.thrust_lines != Sheet::ThrustLines::none; });
  if ((e.shell.num_rings() == 0 || !has_lines) && !scene.postproc.meridians.empty())
    e.warnings.push_back(
        "thrust lines along postproc.meridians were left out: the blocks have no courses about an axis");
  e.meridians = evaluate_meridians(e);
  add_ends_of_thrust(results, &e);
  evaluate_cuts(left_out, &e);
  if (e.assembly.members.empty() && !scene.geometry.imported && !scene.geometry.window)  // one bond
    e.rib_over_mid_sail = rib_ratio(thrust_input(e, e.last), last_member(scene.geometry).bond);
  e.warnings.insert(e.warnings.end(), doubts.begin(), doubts.end());
  return e;
}

}  // namespace cupola
