// The sentences of the report: verdict, solution quality, findings of an equilibrium.

#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/report/first_screen.hpp"
#include "postproc/report/report.hpp"
#include "postproc/report/worst_joints.hpp"
#include "postproc/tables/post_summary.hpp"

namespace cupola {
namespace {

/// A percentage, or the word for a quantity that the floor sets to zero.
std::string percent(double share) {
  return share == 0.0 ? "negligible" : fmt::format("{:.1f} %", 100.0 * share);
}

/// True if the first screen has a number of this name.
bool leads(const std::vector<KeyNumber>& numbers, const char* name) {
  return std::any_of(numbers.begin(), numbers.end(), [name](const KeyNumber& n) { return n.name == name; });
}

void add_rings(const Evaluation& e, const PostSummary& s, std::vector<std::string>* out) {
  if (!s.largest_ring_difference) return;
  constexpr double kBalanced = 0.01;  // a dynamic run at rest still has small accelerations
  const char* ring = is_vault(e) ? "ring" : "course";
  out->push_back(
      *s.largest_ring_difference <= kBalanced
          ? fmt::format("In every {} the joint forces balance the load above; the largest "
                        "relative difference is {:.1e}.",
                        ring, *s.largest_ring_difference)
          : fmt::format("The forces of joints and ties below a {} differ from the load above by up to {:.1e} "
                        "of it: inertia carries the rest.",
                        ring, *s.largest_ring_difference));
  out->push_back(*s.largest_cv_pressure == 0.0
                     ? fmt::format("The bed pressure is the same on all blocks of a {}: its coefficient of "
                                   "variation is negligible.",
                                   ring)
                     : fmt::format("The coefficient of variation of the bed pressure within a {0} is {1} on "
                                   "average over the {0}s and {2} at most.",
                                   ring, percent(*s.mean_cv_pressure), percent(*s.largest_cv_pressure)));
}

/// Couple lengths of two kinds of resultants, which differ: a strip adds parts of several blocks.
std::string couple_text(const Evaluation& e, const PostSummary& s) {
  std::string text = "The largest couple length of the wrench on a block from the course below is " +
                     length_text(*s.largest_couple_length_m);
  if (e.meridians.empty()) return text + ".";
  double strips = 0.0;
  for (const MeridianEvaluation& m : e.meridians) strips = std::max(strips, m.thrust.largest_couple_length());
  return text + ", that of the resultant of a strip of a thrust line " + length_text(strips) + ".";
}

std::string friction_text(const Evaluation& e, const PostSummary& s) {
  const double use = s.largest_friction_use.value_or(0.0);
  const auto& joints = e.last.joints.wrenches;
  if (use == 0.0)
    return std::ranges::any_of(joints, [&e](const JointWrench& j) { return uses_friction(e, j); })
               ? "Friction only resists turning or opposes itself: the resultants of all joints are normal "
                 "to "
                 "them."
               : "Friction is not used: the tangential forces of all joints are negligible.";
  const auto at_limit = std::count_if(joints.begin(), joints.end(),
                                      [](const JointWrench& j) { return j.friction_use > kSlides; });
  return at_limit > 0
             ? fmt::format("{} of {} are at their friction limit.", at_limit, counted(joints.size(), "joint"))
             : fmt::format("The largest friction use of a joint is {}.", percent(use));
}

std::string strength_text(const PostSummary& s) {
  return fmt::format(
      "The largest pressure on a joint is {:.3g} MPa. Of its compressive or tensile strength a joint "
      "uses at most {}.",
      1e-6 * s.largest_pressure_Pa.value_or(0.0), percent(*s.largest_strength_use));
}

std::string chain_text(const ChainForces& chain) {
  std::string text = fmt::format("The chain {} at {:.4g} m ", chain.name, chain.height);
  text += chain.greatest == 0.0
              ? "is slack all round"
              : fmt::format("carries a tension of {} on average, from {} to {}", force_text(chain.mean),
                            force_text(chain.least), force_text(chain.greatest));
  if (chain.yielding > 0)
    text += fmt::format("; {} of {} {}", chain.yielding, counted(chain.bars, "bar"),
                        chain.yielding == 1 ? "yields" : "yield");
  if (chain.yielded > 0.0)
    text += fmt::format("; plastic elongation {} in total", length_text(chain.yielded));
  return text + ".";
}

}  // namespace

std::vector<std::string> finding_sentences(const Evaluation& e) {
  const PostSummary s = post_summary(e);
  std::vector<std::string> out;
  const std::vector<KeyNumber> leading = key_numbers(e, {});  // is not repeated
  if (s.largest_strength_use && !leads(leading, kLargestPressure)) out.push_back(strength_text(s));
  for (const PlaneCut& cut : e.planes)
    out.push_back(fmt::format(
        "The joints across the plane {} transmit {} to the part beyond{}.", cut.name,
        normal_force_text(above(cut.across.force.dot(cut.normal), s.negligible_force_N)),
        cut.from_ties.isZero(0.0) ? ""
                                  : ", and the ties " + normal_force_text(above(cut.from_ties.dot(cut.normal),
                                                                                s.negligible_force_N))));
  for (const ChainForces& chain : e.chains) out.push_back(chain_text(chain));
  add_rings(e, s, &out);
  if (s.rib_over_mid_sail)
    out.push_back(fmt::format(
        "The resultant in the rib is on average {:.3f} times that at mid-sail, and between {:.2f} "
        "and {:.2f} times on a single bed ({}).",
        *s.rib_over_mid_sail, *s.rib_over_mid_sail_smallest, *s.rib_over_mid_sail_largest,
        is_rigid(e) ? "rigid joints" : "compliance per " + s.compliance_per));
  if (!e.rings.empty() && s.largest_couple_length_m) out.push_back(couple_text(e, s));
  out.push_back(friction_text(e, s));
  if (s.mean_kern_use)
    out.push_back(
        *s.mean_kern_use == 0.0
            ? std::string("The bed forces act at the centres of the beds: their mean eccentricity is "
                          "negligible.")
            : fmt::format("The mean eccentricity of the bed forces is {:.2f} of the distance to the edge of "
                          "the kern. Where it exceeds 1, part of the joint is unloaded or pulls.",
                          *s.mean_kern_use));
  if (s.max_displacement_m)
    out.push_back(fmt::format(
        "The largest displacement of a block is {}{}.", length_text(*s.max_displacement_m),
        e.summary.max_displacement_time_s ? fmt::format(", at {:.4g} s", *e.summary.max_displacement_time_s)
        : !moved_text(e).empty()          ? ", the motion of the supports included"
                                          : ""));
  return out;
}

bool shows_bracket(const CriticalValue& critical) {
  return fmt::format("{:.5g}", critical.stable) != fmt::format("{:.5g}", critical.moving);
}

std::string lack_of_equilibrium(const Summary& s, FrameRole shown) {
  if (s.status == Status::collapsed && s.rest_at_end.value_or(false))
    return "it rests only after it collapsed";
  if (shown == FrameRole::step && s.status != Status::unconverged) return "it is in motion at its end";
  return s.status == Status::moving ? "no equilibrium exists" : "no equilibrium was found";
}

std::string verdict_text(const Summary& s, FrameRole shown) {
  const bool stages = is_stage(shown), limit = s.critical && !stages;
  if (limit && s.critical->parameter == "peak_stress")
    return fmt::format(
        "In one admissible state no stress exceeds {:.5g} Pa; every other one has a stress of at least "
        "{:.5g} Pa somewhere. The forces below are those of the state found.",
        s.critical->stable, s.critical->moving);
  if (limit && !shows_bracket(*s.critical))
    return fmt::format(
        "The structure stands {} {} and moves {} it. The forces on this page are those at this value, not "
        "those of the case.",
        s.critical->stable < s.critical->moving ? "up to" : "down to",
        phrase(s.critical->parameter, s.critical->stable),
        s.critical->stable < s.critical->moving ? "beyond" : "below");
  if (limit)
    return fmt::format(
        "The structure stands at {} and moves at {:.5g}. The forces on this page are those at {:.5g}, not "
        "those of the case.",
        phrase(s.critical->parameter, s.critical->stable), s.critical->moving, s.critical->stable);
  if (!s.ranges.empty() && stands(s.status))
    return "Forces exist that balance the loads within the joint laws.";
  if (!s.ranges.empty())
    return "Forces exist that balance the loads, but not all ends of the ranges reached the requested "
           "accuracy.";
  if (s.analysis == AnalysisType::range && moves(s.status))
    return "The structure moves: no forces balance the loads within the joint laws.";
  switch (s.status) {
    case Status::stable:
    case Status::stable_unproven:
      return stages ? "Every stage of the construction stands." : "The structure is at rest.";
    case Status::moving:
    case Status::moving_unproven:
      if (stages) return "Not every stage of the construction stands.";
      if (shown == FrameRole::step) return "The structure is moving.";
      return fmt::format("{}{}.",
                         shown == FrameRole::path ? "Beyond the end of the path " : "Under these loads ",
                         lack_of_equilibrium(s, shown));
    case Status::collapsed:
      return "The structure has collapsed.";
    case Status::bracketed:
    case Status::unconverged:
      return fmt::format("No verdict: {}.", s.message);
  }
  return "";
}

std::vector<std::string> quality_sentences(const Evaluation& e) {
  const Summary& s = e.summary;
  const FrameRole shown = e.last.frame.role;
  const bool equilibrium = at_rest(e), in_time = s.max_speed_m_per_s.has_value();
  std::vector<std::string> out{to_sentence(s.accuracy)};
  const auto add = [&out](std::string text) { out.push_back(std::move(text)); };
  if (s.critical && !is_stage(shown))
    add(fmt::format("The residuals below are those of the equilibrium at {:.5g}.", s.critical->stable));
  if (equilibrium && s.equilibrium_residual)  // in motion it is mostly inertia
    add(fmt::format("The largest unbalanced force on a free block is {:.1e} of the mean block weight.",
                    *s.equilibrium_residual));
  if (equilibrium || in_time) {  // a static solve without an equilibrium has no forces
    if (s.contact_law_residual)
      add(fmt::format("The contact law holds to within {:.1e} of the forces{}.", *s.contact_law_residual,
                      s.steps > 1 && shown != FrameRole::equilibrium ? " in every step" : ""));
    if (const auto& worst = s.largest_law_violation)
      add(fmt::format(
          "At the worst contact, between the blocks {} and {}, the law holds to within {:.1e} of the force "
          "of its joint.",
          worst->block_a, worst->block_b, worst->value));
    if (s.friction_cone_violation)
      add(fmt::format("The friction cone holds to within {:.1e}.", *s.friction_cone_violation));
  }
  if (equilibrium) add(to_sentence(s.certified_force_error));
  if (s.friction_law == FrictionLaw::associated) {
    add("The associated friction law was used: sliding joints also open, by the friction coefficient times "
        "the slip.");
    if (equilibrium) add("A structure that stands under this law may collapse under Coulomb's law.");
    add(fmt::format("Contacts that slip: {} of {}.", s.slipping_contacts, s.contacts));
  } else {
    add(s.friction_law == FrictionLaw::coulomb
            ? std::string("Coulomb's friction law was used: joints slide without opening.")
            : fmt::format("Sliding joints open by {:g} times the friction coefficient times the slip.",
                          s.dilatancy.value_or(1.0)));
    if (equilibrium) add("The equilibrium found need not be the only one.");
    add(fmt::format("Contacts that slip: {} of {}.", s.slipping_contacts, s.contacts));
  }
  if (!proven(s.status))
    add(stands(s.status) ? "Forces balance the loads to the tolerance; that exact ones exist is not proven."
                         : "That no forces balance the loads is not proven.");
  if (equilibrium || in_time)
    add(fmt::format("The largest penetration at a contact is {:.3g} mm.", 1e3 * s.max_penetration_m));
  return out;
}

}  // namespace cupola
