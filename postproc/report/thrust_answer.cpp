// The outward thrust: on which supports, per metre, at which level, and at the springing.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/model/thrust_joint.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/evaluation/thrust.hpp"
#include "postproc/figures/range_text.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {
namespace {

/// The range of the thrust of a vault; without a sheet where no vault has courses.
struct ThrustRange {
  const ForceRange* range = nullptr;
  const Sheet* sheet = nullptr;
};

/// Those of all vaults, that which may push most before the others.
std::vector<ThrustRange> ranges_of_thrust(const Evaluation& e) {
  const std::vector<const Sheet*> pushing = pushing_sheets(e.assembly);
  std::vector<ThrustRange> found;
  for (const ForceRange& range : e.summary.ranges) {
    if (range.quantity == "thrust") found.push_back({&range, pushing.empty() ? nullptr : pushing.front()});
    for (const Sheet* sheet : pushing)
      if (range.quantity == "thrust of " + sheet->name) found.push_back({&range, sheet});
  }
  auto most = found.begin();
  for (auto next = found.begin(); next != found.end(); ++next)
    if (const double most_of_next = greatest(*next->range), so_far = greatest(*most->range);
        most_of_next > so_far && !alike(most_of_next, so_far))
      most = next;
  if (most != found.end()) std::rotate(found.begin(), most, most + 1);
  return found;
}

/// A horizontal direction of the model: "+x", "-y", "30° from x".
std::string direction_text(const Vec3& direction) {
  constexpr double kAlong = 1.0 - 1e-12;
  if (std::abs(direction.x()) > kAlong) return direction.x() > 0.0 ? "+x" : "-x";
  if (std::abs(direction.y()) > kAlong) return direction.y() > 0.0 ? "+y" : "-y";
  return fmt::format("{:.4g}° from x", azimuth(direction) * kDegrees);
}

bool differ(const std::vector<Thrust>& thrusts) {
  return thrusts.size() > 1 && !alike(thrusts[0].force, thrusts[1].force);
}

bool pushes_inwards(const std::vector<Thrust>& thrusts) {
  return thrusts.front().force < 0.0 || (differ(thrusts) && thrusts.back().force < 0.0);
}

/// "12.3 kN", or "12.3 kN and 4.1 kN".
std::string values_text(const std::vector<Thrust>& thrusts) {
  return force_text(thrusts[0].force) + (differ(thrusts) ? " and " + force_text(thrusts[1].force) : "");
}

/// "at the springings towards +x and -x"; "" for one value.
std::string sides_text(const std::vector<Thrust>& thrusts) {
  if (!differ(thrusts)) return "";
  return fmt::format("at the springings towards {} and {}", direction_text(*thrusts[0].towards),
                     direction_text(*thrusts[1].towards));
}

/// N, the part of a thrust that supports bear; all of that on other stacks alone.
double on_supports(const Thrust& thrust) {
  if (!thrust.on_blocks || thrust.supports.empty()) return thrust.force;
  double sum = 0.0;
  for (const Reaction& r : thrust.supports) sum += r.outward;
  return sum;
}

/// m, of the supports along the shell; of an arch on other stacks, which has none, that of its first course.
/// 0: supports of other courses bear the thrust, too.
double length_of(const Evaluation& e, const Sheet& sheet, const Thrust& thrust) {
  double length = 0.0;
  if (thrust.held_higher) return length;
  for (const Reaction& r : thrust.supports) length += r.length;
  if (!thrust.supports.empty() || sheet.thrust_lines != Sheet::ThrustLines::one) return length;
  const Vec3 along(-std::sin(sheet.turn), std::cos(sheet.turn), 0.0);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Part& part : e.assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      if (part.ring == sheet.first_ring)
        for (const int v : e.assembly.face(f)) {
          low = std::min(low, along.dot(e.assembly.vertices[v]));
          high = std::max(high, along.dot(e.assembly.vertices[v]));
        }
  return std::max(high - low, 0.0);
}

/// "14.1 kN/m over 5 m of support", "14 kN/m to 16 kN/m over 5 m of support"; "" where the thrust is
/// negligible or the length unknown.
std::string per_metre(double least, double greatest, double length) {
  if ((least == 0.0 && greatest == 0.0) || !(length > 0.0)) return "";
  const std::string from = force_text(least / length), to = force_text(greatest / length);
  return fmt::format("{}{}/m over {} of support", from == to ? "" : from + "/m to ", to, length_text(length));
}

/// The cut under the lowest course whose intrados leans, where a vault springs from its walls; null if all
/// of the stack is upright.
const RingSum* springing_of(const Evaluation& e, const Sheet& sheet) {
  constexpr double kUpright = 1e-6;  // cosine; planes are exact to rounding
  const auto [first, end] = e.assembly.stack_of(sheet.first_ring);
  int lowest = std::min(end, static_cast<int>(e.rings.size()));
  const int none = lowest;
  for (const Part& part : e.assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      if (part.ring >= first && part.ring < lowest && e.assembly.face_kinds[f] == FaceKind::intrados &&
          std::abs(polygon_plane(face_points(e.assembly, f)).normal.z()) > kUpright)
        lowest = part.ring;
  return lowest < none ? &e.rings[lowest] : nullptr;
}

constexpr const char* kAndHigher = ", and at supports of higher courses";

bool is_held_higher(const std::vector<Thrust>& thrusts) {
  return std::ranges::any_of(thrusts, &Thrust::held_higher);
}

std::string at_level(const std::string& name, const RingSum& cut) {
  constexpr double kShown = 1e-4;  // m
  return fmt::format("at the {}, z = {:g} m", name, std::round(cut.height / kShown) * kShown + 0.0);
}

/// "at the springing, z = 0 m", or "at the base, z = -4.5 m" and "at the springing, z = 0 m: 21.3 kN". The
/// courses of an arch are counted from one side: where the sides differ, the other value is not known. Nor is
/// it where supports hold higher courses, whose push is none of the sum over one course.
std::vector<std::string> level_texts(const Evaluation& e, const Sheet& sheet,
                                     const std::vector<Thrust>& thrusts) {
  const RingSum &base = base_of(e, sheet), *springing = springing_of(e, sheet);
  const bool held_higher = is_held_higher(thrusts);
  const std::string at_base =
      at_level(springing == &base ? "springing" : "base", base) + (held_higher ? kAndHigher : "");
  if (!springing || springing == &base || differ(thrusts) || held_higher) return {at_base};
  return {at_base,
          fmt::format("{}: {}", at_level("springing", *springing), force_text(springing->radial_thrust))};
}

/// Names of the members whose courses interlock.
std::vector<std::string> interlocked(const std::vector<const Member*>& members) {
  std::vector<std::string> names;
  for (const Member* member : members)
    if (!std::ranges::all_of(bonds_of(*member),
                             [](const Bond* bond) { return std::holds_alternative<StackBond>(*bond); }))
      names.push_back(member->name);
  return names;
}

/// An inward thrust on rings that only weigh: they pull with it by the friction of their bond.
std::string pull_of_rings(const Geometry& geometry, double tension) {
  std::string text = fmt::format(
      ", where the courses hold together by a hoop tension of {} net of compression, through the "
      "friction of their bond",
      force_text(tension));
  const std::vector<const Member*> members = members_of(geometry);
  const std::vector<std::string> bonded = interlocked(members);
  if (geometry.imported || bonded.empty()) return text;
  return text + fmt::format("; masonry cracked along meridians has none: try `bond: {{type: stack}}`{}{}",
                            members.size() > 1 ? " of " : "",
                            members.size() > 1 ? fmt::format("{}", fmt::join(bonded, " and ")) : "");
}

/// That which a range counts: of an arch at the springing towards +x.
Thrust counted_by_range(const Evaluation& e, const Sheet& sheet) {
  std::vector<Thrust> thrusts = thrusts_of(e, sheet);
  const bool second = thrusts.size() > 1 && thrusts[1].towards->dot(sheet.towards(0.0)) > 0.0;
  return std::move(thrusts[second ? 1 : 0]);
}

/// "14 kN/m to 16 kN/m over 5 m of support" and "at the base, z = 0 m", of the stack of the range.
std::vector<std::string> place_of_range(const Evaluation& e, const Sheet& sheet, const ForceRange& range) {
  const Thrust counted = counted_by_range(e, sheet);
  std::vector<std::string> out;
  const bool is_shared = counted.on_blocks && !counted.supports.empty();  // in parts that it does not know
  if (!is_shared && std::isfinite(least(range)) && std::isfinite(greatest(range)))
    out.push_back(per_metre(least(range), greatest(range), length_of(e, sheet, counted)));
  std::erase(out, "");
  const RingSum& base = base_of(e, sheet);
  std::string level = springing_of(e, sheet) == &base ? "springing" : "base";
  if (counted.towards) level += " towards " + direction_text(*counted.towards);
  out.push_back(at_level(level, base) + (counted.held_higher ? kAndHigher : ""));
  return out;
}

/// "12 kN on each of 4 supports" or "between 3 kN and 12 kN on each of 4 supports"; "" for one support.
std::string spread_over(const std::vector<Reaction>& supports) {
  if (supports.size() < 2) return "";
  const auto [lowest, highest] = std::ranges::minmax(supports, {}, &Reaction::outward);
  if (alike(lowest.outward, highest.outward))
    return fmt::format("{} on each of {}", force_text(highest.outward), counted(supports.size(), "support"));
  return fmt::format("between {} and {} on each of {}",
                     lowest.outward == 0.0 ? "0" : force_text(lowest.outward), force_text(highest.outward),
                     counted(supports.size(), "support"));
}

/// What the supports under a vault on other members bear outwards: these push, too. "" where it is the thrust.
/// Outwards is from one vault: a pier under several may bear more in another direction.
std::string under_the_bearers(const Evaluation& e, const std::vector<const Sheet*>& pushing) {
  double thrust = 0.0, borne = 0.0, outwards = 0.0, most = 0.0;  // N, both sums, and the largest of a support
  bool on_blocks = false;
  for (const Sheet* sheet : pushing)
    for (const Thrust& side : thrusts_of(e, *sheet)) {
      thrust += side.force;
      on_blocks |= side.on_blocks;
    }
  for (const Reaction& r : e.reactions) {
    borne += r.outward;
    outwards = std::max(outwards, r.outward);
    most = std::max(most, r.force.head<2>().norm());
  }
  if (!on_blocks || e.reactions.empty()) return "";
  const bool aside = most > outwards && !alike(most, outwards);
  if (alike(thrust, borne) && !aside) return "";
  return "the supports bear outwards " +
         (e.reactions.size() > 1 ? spread_over(e.reactions) : force_text(e.reactions.front().outward)) +
         (aside ? fmt::format(", horizontally up to {}", force_text(most)) : "");
}

/// "of the joints alone; a tie or restraint carries up to 104 kN"; "" without any.
std::string beside_ties(const Evaluation& e) {
  const std::vector<double>& forces = e.last.frame.ties.force;
  if (forces.empty()) return "";
  return fmt::format("of the joints alone; a tie or restraint carries up to {}",
                     force_text(std::ranges::max(forces)));
}

KeyNumber answer_of_ranges(const Evaluation& e, const std::vector<ThrustRange>& ranges) {
  const auto& [first, vault] = ranges.front();
  const ForceRange& range = *first;
  std::vector<std::string> details{"certain for every history"};
  if (range.chosen)
    details.push_back(fmt::format("the stiffness of the joints selects {}{}",
                                  range_number(*range.chosen, range), range_unit(range).after_blank()));
  const std::vector<const Sheet*> standing = pushing_sheets(e);
  if (vault && ranges.size() > 1) details.push_back("of " + vault->name);
  if (vault && std::ranges::find(standing, vault) != standing.end() && !e.rings.empty()) {
    for (std::string& text : place_of_range(e, *vault, range)) details.push_back(std::move(text));
    if (const std::string under = under_the_bearers(e, standing); !under.empty())
      details.push_back(fmt::format("in the state selected {}, whose range is that of a `reaction`", under));
  }
  if (least(range) < 0.0) {
    details.emplace_back("inwards where negative");
    if (const auto tension = net_hoop_tension(e, least(range)))
      details.back() += pull_of_rings(e.scene.geometry, *tension);
  }
  if (!e.last.frame.ties.force.empty())
    details.emplace_back("of the joints alone, without ties and restraints");
  for (const auto& [other, sheet] : ranges)
    if (sheet && other != first) details.push_back(fmt::format("of {} {}", sheet->name, range_ends(*other)));
  return {"Outward thrust", range_ends(range), details};
}

/// What supports bear of the thrust per metre; "" where those of other courses bear it, too.
std::string along_supports(const Evaluation& e, const Sheet& sheet, const std::vector<Thrust>& thrusts) {
  if (is_held_higher(thrusts)) return "";
  const auto length = [&](const Thrust& thrust) { return length_of(e, sheet, thrust); };
  const auto per_length = [&](const Thrust& thrust) { return on_supports(thrust) / length(thrust); };
  const Thrust& most = *std::ranges::max_element(thrusts, {}, per_length);
  const std::string along = per_metre(on_supports(most), on_supports(most), length(most));
  if (along.empty() || thrusts.size() == 1) return along;
  const bool is_even = !differ(thrusts) && alike(length(thrusts.front()), length(thrusts.back()));
  return (is_even ? "on each side, " : "at most ") + along;
}

/// The thrusts of further stacks.
std::vector<std::string> thrusts_of_others(const Evaluation& e, const std::vector<const Sheet*>& pushing) {
  constexpr size_t kMost = 5;  // stacks
  std::vector<std::string> out;
  for (size_t i = 1; i < std::min(pushing.size(), kMost); ++i) {
    const std::vector<Thrust> others = thrusts_of(e, *pushing[i]);
    std::string text = fmt::format("of {} {}{}", pushing[i]->name, values_text(others),
                                   pushes_inwards(others) ? ", negative: inwards" : "");
    if (differ(others)) text += fmt::format(" {}", sides_text(others));
    const std::string along = along_supports(e, *pushing[i], others);
    out.push_back(text + (along.empty() ? "" : ", ") + along);
  }
  if (pushing.size() > kMost) out.emplace_back("of the others in rings.csv");
  return out;
}

std::string share_of_weight(const Evaluation& e, double thrust) {
  return thrust != 0.0 && e.summary.weight_N > 0.0
             ? fmt::format("{:.3g} of the weight", thrust / e.summary.weight_N)
             : "";
}

/// How the thrust of one equilibrium depends on what is not certain.
std::string doubt_of(const Evaluation& e) {
  if (e.summary.critical && !is_stage(e.last.frame.role))
    return "at the critical value, not that of the case";
  if (e.summary.forces_unique.reason == ForcesUnique::kOneOfMany)
    return "of one of the admissible states: their range was not computed";
  return "depends on the stiffness of the joints: the range over all states was not computed";
}

KeyNumber thrust_without_courses(const Evaluation& e, double thrust) {
  std::vector<std::string> details;
  if (thrust < 0.0) details.emplace_back("negative: inwards");
  details.emplace_back("the sum over the supports");
  details.front().insert(0, after_last_stage(e));
  for (const std::string& text : {spread_over(e.reactions), share_of_weight(e, thrust), doubt_of(e)})
    if (!text.empty()) details.push_back(text);
  return {"Outward thrust", force_text(thrust), details};
}

}  // namespace

std::optional<KeyNumber> thrust_answer(const Evaluation& e) {
  if (const std::vector<ThrustRange> ranges = ranges_of_thrust(e); !ranges.empty())
    return answer_of_ranges(e, ranges);
  const std::optional<double> found = at_rest(e) ? outward_thrust(e) : std::nullopt;
  if (!found || (*found == 0.0 && is_stage(e.last.frame.role)))
    return std::nullopt;  // the course laid last rests on others
  const std::vector<const Sheet*> pushing = pushing_sheets(e);
  if (pushing.empty()) return thrust_without_courses(e, *found);
  const Sheet& shell = *pushing.front();
  const bool alone = pushing.size() == 1 && e.summary.parts.empty();  // of which others may have fallen
  const std::vector<Thrust> thrusts = thrusts_of(e, shell);
  std::vector<std::string> details;
  const auto add = [&details](std::string text) {
    if (!text.empty()) details.push_back(std::move(text));
  };
  if (pushes_inwards(thrusts)) add("negative: inwards");
  std::string along = along_supports(e, shell, thrusts);
  if (!alone) along = fmt::format("of {}{}{}", shell.name, along.empty() ? "" : ", ", along);
  add(sides_text(thrusts));
  add(std::move(along));
  for (std::string& text : level_texts(e, shell, thrusts)) add(std::move(text));
  if (!thrusts.front().on_blocks) add(spread_over(thrusts.front().supports));
  if (alone) add(share_of_weight(e, thrusts.front().force));
  for (std::string& text : thrusts_of_others(e, pushing)) add(std::move(text));
  add(under_the_bearers(e, pushing));
  add(beside_ties(e));
  add(doubt_of(e));
  details.front().insert(0, after_last_stage(e));
  return KeyNumber{"Outward thrust", values_text(thrusts), details};
}

}  // namespace cupola
