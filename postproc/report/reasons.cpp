// Why it stands or falls, and what is certain of it: the sentences of the first screen.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/base/counted.hpp"
#include "assembly/case/limit_parameter.hpp"
#include "assembly/model/laying_course.hpp"
#include "postproc/evaluation/margin.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/report/gives_way.hpp"
#include "postproc/report/loads_text.hpp"
#include "postproc/report/motion.hpp"
#include "postproc/report/report.hpp"

namespace cupola {

/// The parts that a static analysis solved one by one, by what they do, proven or not.
std::map<std::string, std::vector<PartVerdict>> parts_by_verdict(const Summary& summary) {
  std::map<std::string, std::vector<PartVerdict>> found;
  for (const PartVerdict& part : summary.parts) {
    found[stands(part.status) ? "It stands" : moves(part.status) ? "It falls" : "Undecided"].push_back(part);
  }
  return found;
}

std::string moved_text(const Evaluation& e) {
  const BlockTable& blocks = e.last.frame.blocks;
  const double least = e.last.joints.floor.length;
  std::vector<size_t> moved;
  double farthest = 0.0, turn = 0.0;
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b) {
    const Block& block = e.assembly.blocks[b];
    if (!block.fixed) continue;
    const Eigen::Vector4d& q = blocks.quaternion_wxyz[b];
    const double distance = blocks.displacement[b].norm();
    const double angle = 2.0 * std::atan2(q.tail<3>().norm(), std::abs(q[0]));
    const bool shifts = distance > least, turns = angle * std::cbrt(block.volume) > least;
    if (shifts || turns) moved.push_back(b);
    if (shifts) farthest = std::max(farthest, distance);
    if (turns) turn = std::max(turn, angle);
  }
  if (moved.empty()) return "";
  const bool several = moved.size() > 1;
  const char* up_to = several ? "up to " : "";
  std::vector<std::string> how;
  if (farthest > 0.0) how.push_back(fmt::format("moved by {}{}", up_to, length_text(farthest)));
  const std::string degrees = fmt::format("{:.3g}", turn * kDegrees);
  if (turn > 0.0)
    how.push_back(fmt::format("turned by {}{} degree{}", up_to, degrees, degrees == "1" ? "" : "s"));
  const std::string& name = e.assembly.blocks[moved.front()].name;
  return fmt::format("{} {}",
                     several        ? counted(moved.size(), "support") + " have"
                     : name.empty() ? fmt::format("support block {} has", moved.front())
                                    : name + " has",
                     fmt::join(how, " and "));
}

namespace {

/// The laws that joints have in the run: in stages of construction fresh mortar's, too.
Joints laws_of(const Evaluation& e) {
  Joints joints = e.scene.joints;
  if (!is_stage(e.last.frame.role)) return joints;
  const StagedConstruction& staged = e.scene.analysis.staged;
  if (staged.curing.empty()) joints.rings.push_back({.law = staged.fresh.law()});
  for (const CuringMortar& row : staged.curing) joints.rings.push_back({.law = row.law});
  return joints;
}

/// True if the run shows one equilibrium under the loads of its case: no limit, range or stage.
bool shows_the_case(const Evaluation& e) {
  return at_rest(e) && !e.summary.critical && e.summary.ranges.empty() && !is_stage(e.last.frame.role);
}

/// "by friction and without tension"; with ties "by friction, without tension in the joints, and by the ties".
std::string balance_text(const Evaluation& e) {
  const std::string ties = acting_ties(e);
  if (e.last.joints.wrenches.empty() && !ties.empty()) return "in the " + ties;
  const char* joints = laws_of(e).have_strength() ? "within the limits of the joints"
                       : ties.empty()             ? "by friction and without tension"
                                                  : "by friction, without tension in the joints";
  return ties.empty() ? joints : fmt::format("{}, and by the {}", joints, ties);
}

/// Why one equilibrium stands: what carries what, and after which motion.
std::string carried_text(const Evaluation& e) {
  const std::string loads = loads_text(e);
  const std::string carry =
      fmt::format("The {} carry the weight of {}, {}{}{}", carriers_text(e),
                  counted(e.summary.free_blocks, "block"), weight_text(e), loads.empty() ? "" : ", ", loads);
  if (const std::string moved = moved_text(e); !moved.empty())
    return fmt::format("{}, although {}.", carry, moved);
  if (e.last.frame.role == FrameRole::step)
    return fmt::format("{}, at rest after {:.4g} s of motion, in which {}.", carry, e.last.frame.time,
                       largest_displacement_text(e));
  if (e.last.frame.role == FrameRole::path) return carry + ", at the end of the path.";
  return carry + ".";
}

/// How a motion in time ended that does not stand: by how much the blocks have moved, and what still moves.
std::string motion_text(const Evaluation& e) {
  const double threshold = e.scene.analysis.thresholds.collapse();
  const std::string moved =
      fmt::format("Within {:.4g} s {}; a displacement above {} counts as collapse.", e.last.frame.time,
                  largest_displacement_text(e), length_text(threshold));
  if (e.summary.status == Status::collapsed) {
    const LargestDisplacement largest = largest_displacement(e);
    if (!largest.at_end || *largest.at_end > threshold || !e.summary.rest_at_end.value_or(false))
      return moved;
    return fmt::format(
        "{} At the end it is at rest: with `analysis.thresholds.displacement` above {} it counts as "
        "standing.",
        moved, length_text(largest.distance));
  }
  return fmt::format(
      "{} At the end it is not at rest: {}. It may vibrate with its loads, come to rest, or fall: "
      "follow it for longer.",
      moved, e.summary.message);
}

/// "the shape of the blocks, their weight and loads, a coefficient of friction of 0.4, no crushing (not
/// checked)". Loads have their sums unless the reason of the verdict gives them.
std::string assumptions(const Evaluation& e) {
  const auto& critical = e.summary.critical;
  const std::string loads = shows_the_case(e) ? "" : loads_text(e);
  std::vector<std::string> given{
      e.scene.geometry.imported ? "the shape of the imported blocks" : "the shape of the blocks",
      critical && critical->parameter == "load" ? "their weight, where the loads act and in which direction"
                                                : "their weight and loads"};
  if (!loads.empty())
    given.back() += fmt::format(" (weight of {}, {}{})", weight_text(e), loads,
                                critical && !is_stage(e.last.frame.role) ? " at the critical value" : "");
  const Joints laws = laws_of(e);
  const bool varied = critical && critical->parameter == "friction";
  if (!varied || !varied_joints(e.scene.analysis.limit).empty())
    given.push_back(friction_text(laws) + (varied ? " of the other joints" : ""));
  if (laws.have_strength())
    given.emplace_back(e.scene.joints.have_strength() ? "the strength of the joints"
                                                      : "the strength of fresh mortar");
  if (const std::string ties = assumed_ties(e); !ties.empty()) given.push_back(ties);
  if (!e.scene.loads.heat.empty()) given.emplace_back("the changes of temperature");
  if (!moved_text(e).empty()) given.push_back("the motion of the supports");
  if (std::isinf(compressive_strengths(e.scene.joints).first)) given.push_back("no crushing (not checked)");
  return fmt::format("{}", fmt::join(given, ", "));
}

/// A critical factor on the loads of the case: which it multiplies, and which not.
std::string factor_on_loads_text(const Loads& loads, double factor) {
  const auto is_fill = [](const FaceLoad& load) { return load.fill.has_value(); };
  const bool filled = std::ranges::any_of(loads.faces, is_fill), topped = loads.lantern || loads.top_load;
  const bool on_faces = !std::ranges::all_of(loads.faces, is_fill);
  const std::string_view multiplied = !on_faces              ? "forces"
                                      : loads.forces.empty() ? "loads on faces"
                                                             : "forces and loads on faces";
  const std::string_view kept = filled && topped ? " (not its fill and load on top)"
                                : filled         ? " (not its fill)"
                                : topped         ? " (not its load on top)"
                                                 : "";
  if (factor < 1.0)
    return fmt::format("It bears only {:.5g} times the {} of the case{}.", factor, multiplied, kept);
  return fmt::format("The {} of the case{} can grow to {:.5g} times before it moves.", multiplied, kept,
                     factor);
}

/// A limit: on which side of it the case is, and by which factor.
std::string limit_text(const Evaluation& e) {
  const CriticalValue& critical = *e.summary.critical;
  const std::optional<double> own = value_of_case(e.scene, critical.parameter);
  const std::optional<double> factor = factor_of_safety(e.scene, e.summary);
  if (!own || !factor) {
    const LimitSearch& limit = e.scene.analysis.limit;
    const std::string direction = direction_of_limit(e.scene), joints = varied_joints(limit);
    return verdict_text(e.summary, e.last.frame.role) +
           (direction.empty() ? "" : fmt::format(" It is {}.", direction)) +
           (joints.empty() ? ""
                           : fmt::format(" It is the friction{} alone; the others keep theirs.", joints));
  }
  const bool holds = *factor >= 1.0;
  std::string text;
  if (critical.parameter == "load" && critical.stable < critical.moving)
    text = factor_on_loads_text(e.scene.loads, *factor);
  else if (critical.parameter == "joint_extent")
    text =
        fmt::format("Its joints can shrink to {:.4g} times their extent before it moves.", critical.stable);
  else
    text = fmt::format("The case has {}{}: it stands {} {:.5g} and moves {}.",
                       phrase(critical.parameter, *own), distance_from_limit(*factor, critical),
                       critical.stable < critical.moving ? "up to" : "down to", critical.stable,
                       shows_bracket(critical)             ? fmt::format("at {:.5g}", critical.moving)
                       : critical.stable < critical.moving ? "beyond it"
                                                           : "below it");
  if (critical.parameter == "joint_extent" && !holds)
    text = fmt::format("It moves unless its joints were {:.4g} times as large.", critical.stable);
  if (e.summary.friction_law == FrictionLaw::associated)
    text.insert(text.size() - 1, " (associated friction law)");
  return text + fmt::format(" Picture and thrust belong to the critical {}, not to the case.",
                            in_words(critical.parameter));
}

/// A limit: existence on one side is certain; what lies beyond is as certain as the run says.
std::string certain_of_limit(const Evaluation& e) {
  const CriticalValue& critical = *e.summary.critical;
  const std::string standing = phrase(critical.parameter, critical.stable);
  if (e.summary.friction_law != FrictionLaw::associated)
    return fmt::format(
        "Certain: an equilibrium was found at {}. Not certain: that there is none beyond. Assumed: {}, and "
        "the stiffness of the joints.",
        standing, assumptions(e));
  // Nothing is less than none.
  const std::string instead = critical.stable == 0.0
                                  ? ""
                                  : fmt::format("; it may {} {}",
                                                critical.stable < critical.moving     ? "fall at a lower"
                                                : critical.parameter == "peak_stress" ? "need a higher"
                                                                                      : "need more",
                                                in_words(critical.parameter));
  return fmt::format(
      "{}: at {} forces balance the loads, whatever the stiffness of the joints and their history. Not "
      "certain: that it stands there under Coulomb's law, by which joints slide without opening{}. Assumed: "
      "{}.",
      proven(e.summary.status) ? "Certain" : "To the tolerance", standing, instead, assumptions(e));
}

}  // namespace

std::string reason_for_verdict(const Evaluation& e) {
  if (at_rest(e) && !e.summary.parts.empty()) return parts_sentence(e);
  const Summary& s = e.summary;
  std::string text;
  if (const auto latest = s.bears_loads_until_s)
    text = fmt::format("Of the equilibria found none bears more than the loads at {:.4g} s of {:.4g} s. ",
                       *latest, e.scene.analysis.path.end);
  if (shows_the_case(e) && stands(s.status))
    text += carried_text(e);
  else if (e.last.frame.role == FrameRole::step && (s.status == Status::collapsed || moves(s.status)))
    text = motion_text(e);
  else if (s.critical && s.status != Status::unconverged && !is_stage(e.last.frame.role))
    text = limit_text(e);
  else
    text = verdict_text(s, e.last.frame.role);
  if (const int last = e.scene.analysis.staged.last_ring;
      is_stage(e.last.frame.role) && !completes(e.assembly, last))
    text += fmt::format(
        " Computed up to course {} only, with `analysis.staged.last_ring`; the last of the model is {}.",
        last, e.assembly.num_rings - 1);
  if (const std::string how = how_it_gives_way(e); !how.empty() && !s.critical) text += " It " + how + ".";
  if (const std::string parts = parts_sentence(e); !parts.empty()) text += " " + parts;
  return text;
}

std::string certain_sentence(const Evaluation& e) {
  const Summary& s = e.summary;
  const bool limit = s.analysis == AnalysisType::limit && s.critical;
  if (s.status == Status::unconverged && s.ranges.empty())
    return "Nothing is certain: the requested accuracy was not reached.";
  const bool stages = is_stage(e.last.frame.role);
  if (!at_rest(e) && (!s.critical || stages)) {
    const std::string motion = how_sure_of_motion(e);
    return fmt::format("{}{}Assumed: {}.", motion, motion.empty() ? "" : " ", assumptions(e));
  }
  if (limit) return certain_of_limit(e);
  if (!s.ranges.empty())
    return fmt::format(
        "Certain: every state in which it can stand lies inside the ranges. Not known: where inside it is; "
        "that depends on "
        "its history. Assumed: {}.",
        assumptions(e));
  const char* of = stages                   ? "at every stage "
                   : !s.parts.empty()       ? "in the part that stands "
                   : !moved_text(e).empty() ? "after the motion of the supports "
                                            : "";
  const std::optional<KeyNumber> crack = crack_answer(e);
  const std::string stiffness =
      !is_rigid(e) && (thrust_answer(e) || (crack && crack->value != "none"))
          ? fmt::format(", and the {}stiffness of the joints{}, on which thrust and cracks depend",
                        has_default_stiffness(e) ? "default " : "",
                        e.last.frame.ties.size() > 0 ? " and ties" : "")
          : "";
  // That a motion came to rest proves no equilibrium.
  const std::string forces =
      e.last.frame.role == FrameRole::step ? how_sure_of_motion(e)
      : proven(s.status)
          ? fmt::format("Certain: {}forces exist that balance the loads {}.", of, balance_text(e))
          : fmt::format(
                "Not certain: {}forces balance the loads to the tolerance, exact ones were not found.", of);
  std::string text = fmt::format("{} Assumed: {}{}.", forces, assumptions(e), stiffness);
  if (!s.forces_unique.value) text += " " + to_sentence(s.forces_unique);
  return text;
}

namespace {

/// number 7, or its name in the imported file, quoted.
std::string name_of(const Evaluation& e, int block) {
  const std::string& name = e.assembly.blocks[block].name;
  return name.empty() ? fmt::format("number {}", block) : fmt::format("\"{}\"", name);
}

/// "12 blocks", or of one its name too.
std::string blocks_of(const Evaluation& e, const std::vector<PartVerdict>& parts) {
  int blocks = 0;
  for (const PartVerdict& part : parts) blocks += part.blocks;
  return counted(blocks, "block") + (blocks == 1 ? ", " + name_of(e, parts.front().first_block) : "");
}

/// Of a run that solved its parts one by one: "Of 2 unconnected parts one falls (1 block, number 4), one
/// stands (3 blocks)."
std::string sentence_of_verdicts(const Evaluation& e) {
  std::string text;
  for (const auto& [words, parts] : parts_by_verdict(e.summary)) {
    const bool one = parts.size() == 1;
    const std::string verb = words == "It falls"    ? (one ? "falls" : "fall")
                             : words == "Undecided" ? (one ? "is undecided" : "are undecided")
                                                    : (one ? "stands" : "stand");
    text += fmt::format("{}{} {} ({})", text.empty() ? "" : ", ", one ? "one" : std::to_string(parts.size()),
                        verb, blocks_of(e, parts));
  }
  return fmt::format("Of {} unconnected parts {}.{}", e.summary.parts.size(), text,
                     at_rest(e) ? " The numbers belong to what stands." : "");
}

}  // namespace

std::string parts_sentence(const Evaluation& e) {
  if (!e.summary.parts.empty()) return sentence_of_verdicts(e);
  if (is_stage(e.last.frame.role)) return "";  // what is not laid is no part; the stages say what moves
  if (at_rest(e) || e.summary.status == Status::unconverged || e.parts.empty()) return "";
  constexpr double kMoves = 1e-3;  // of the fastest block
  const std::vector<Vec3>& v =
      is_mechanism(e.last.frame.role) ? e.last.frame.blocks.velocity : e.last.frame.blocks.displacement;
  double fastest = 0.0;
  for (const Vec3& x : v) fastest = std::max(fastest, x.norm());
  std::map<int, int> sizes, firsts;
  std::set<int> moving;
  for (int b = 0; b < static_cast<int>(e.parts.size()); ++b) {
    if (e.parts[b] < 0) continue;
    ++sizes[e.parts[b]];
    firsts.try_emplace(e.parts[b], b);
    if (v[b].norm() > kMoves * fastest) moving.insert(e.parts[b]);
  }
  if (sizes.size() < 2 || moving.empty() || moving.size() == sizes.size()) return "";
  int blocks = 0;
  for (const int part : moving) blocks += sizes[part];
  return fmt::format("Of {} unconnected parts {} ({}{}); the others, {}, are at rest.", sizes.size(),
                     moving.size() == 1 ? "one moves" : fmt::format("{} move", moving.size()),
                     counted(blocks, "block"), blocks == 1 ? ", " + name_of(e, firsts[*moving.begin()]) : "",
                     counted(e.summary.free_blocks - blocks, "block"));
}

}  // namespace cupola
