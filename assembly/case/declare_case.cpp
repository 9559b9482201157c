#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <fmt/format.h>

#include "assembly/case/case_times.hpp"
#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

/// What contact points of divided joints and joints with strength cannot be combined with.
void declare_strength_rules(Section& s, Case& the_case) {
  s.rule(
      the_case.contact.subdivide == 1 || (the_case.joints.compliance.per == Compliance::Per::area &&
                                          the_case.contact.method == ContactDetection::Method::face_clipping),
      "contact", "subdivide requires joints.compliance: {per: area} and method: face_clipping");
  const Analysis& analysis = the_case.analysis;
  const StagedConstruction& staged = analysis.staged;
  const bool fresh_strength = analysis.type == AnalysisType::staged &&
                              (staged.fresh.cohesion > 0.0 || staged.fresh.tension > 0.0 ||
                               staged.least == StagedConstruction::Least::cohesion ||
                               std::ranges::any_of(staged.curing, [](const CuringMortar& mortar) {
                                 return mortar.law.cohesion || mortar.law.tension;
                               }));
  s.rule(!fresh_strength || the_case.joints.compliance.per == Compliance::Per::area, "analysis",
         "staged: cohesion and tension of fresh mortar require joints.compliance: {per: area}");
  s.rule(analysis.method != ContactMethod::interior_point || !the_case.ties_yield(), "analysis",
         "method: interior_point requires ties without yield_force; use newton");
  if (!the_case.joints.have_strength() && !fresh_strength) return;
  s.rule(
      the_case.joints.failure == JointFailure::plastic || analysis.type == AnalysisType::dynamic ||
          analysis.type == AnalysisType::path || (analysis.type == AnalysisType::staged && staged.carry),
      "analysis",
      "joints.failure: brittle or softening requires type: dynamic, path, or staged with carry, because what "
      "such joints carry depends on the history of the loads");
  s.rule(analysis.method != ContactMethod::interior_point, "analysis",
         "method: interior_point requires joints without strength; use newton");
  s.rule(the_case.contact.method == ContactDetection::Method::face_clipping, "contact",
         "joints with tension, cohesion or compressive_strength require method: face_clipping");
}

void declare_heat_rules(Section& s, const Case& the_case) {
  if (the_case.loads.heat.empty()) return;
  const Analysis& analysis = the_case.analysis;
  const bool is_static = analysis.type == AnalysisType::static_;
  s.rule(is_static || analysis.type == AnalysisType::path || analysis.type == AnalysisType::dynamic, "loads",
         "heat requires analysis.type: static, path or dynamic; admissible forces do not depend on it, and "
         "stages are computed at one temperature");
  s.rule(analysis.cyclic_sectors == 1 && !analysis.sleep, "loads",
         "heat excludes analysis.cyclic_sectors and analysis.sleep");
  for (size_t i = 0; i < the_case.loads.heat.size(); ++i)
    s.rule(is_static || factor_at(the_case.loads.heat[i].time, 0.0) == 0.0, "loads",
           fmt::format("heat[{}].time: must be 0 at the time 0, at which the blocks are as built; give a "
                       "ramp or a sine: {{type: ramp}}",
                       i));
}

/// Not of `load` limits, whose forces are unit loads, which the analysis multiplies.
void expect_face_loads(const Section& s, const Case& the_case) {
  const Analysis& analysis = the_case.analysis;
  if (analysis.type == AnalysisType::limit && analysis.limit.parameter == LimitSearch::Parameter::load)
    return;
  for (size_t i = 0; i < the_case.loads.faces.size(); ++i)
    for (const auto& [key, value] : {std::pair("traction", the_case.loads.faces[i].traction.norm()),
                                     std::pair("pressure", std::abs(the_case.loads.faces[i].pressure))})
      if (value > 0.0)
        s.expect({fmt::format("loads.faces[{}].{}", i, key), value, "N/m2", 5.0, 1e8,
                  "in kN/m2? Loads are in N/m2", "too many digits? 1e6 N/m2 is 1 MPa"});
}

/// Pulls are at right angles to gravity: an inclined direction asks for another load than it would get. A
/// level one, as is the default, only says to which side, where gravity is a little inclined.
void declare_pull_rule(Section& s, const Case& the_case) {
  using enum LimitSearch::Parameter;
  constexpr double kInclined = 0.5;  // sine of 30 degrees
  const LimitSearch& limit = the_case.analysis.limit;
  const Vec3& gravity = the_case.loads.gravity;
  const bool vertical = gravity.norm() > 0.0 && gravity.head<2>().norm() <= kInclined * gravity.norm();
  s.rule(the_case.analysis.robustness == 0 || vertical, "analysis.robustness",
         "seeks horizontal multiples of loads.gravity, which must be vertical, within 30 degrees, and not 0");
  if (the_case.analysis.type != AnalysisType::limit ||
      (limit.parameter != tilt && limit.parameter != acceleration))
    return;
  constexpr double kRounding = 1e-3;  // of directions with four digits
  const double along_gravity = limit.direction.dot(gravity.normalized());
  const double allowed = limit.direction.z() == 0.0 ? kInclined : kRounding;
  s.rule(limit.direction.norm() > 0.0 && std::abs(along_gravity) <= allowed * limit.direction.norm(),
         "analysis.limit.direction", "must be horizontal, at right angles to loads.gravity");
}

/// A thickness limit scales the blocks. Anchors elsewhere than in the middle would stay where the shell as
/// built has them, and in a thinner one hang in the air.
void declare_thickness_rule(Section& s, const Case& the_case) {
  if (the_case.analysis.type != AnalysisType::limit ||
      the_case.analysis.limit.parameter != LimitSearch::Parameter::thickness)
    return;
  s.rule(std::ranges::all_of(the_case.geometry.chains, [](const Chain& chain) { return chain.place == 0.5; }),
         "analysis.limit.parameter",
         "requires chains and rods with place: 0.5, in the middle of the thickness, where their "
         "anchors stay; or compare runs with other thicknesses of the member instead, by --set");
}

/// A path follows what changes with time.
void declare_path_rule(Section& s, const Case& the_case) {
  if (the_case.analysis.type != AnalysisType::path || the_case.supports.base_motion) return;
  const std::vector<KeyedTime> times = times_of(the_case);
  const bool changes =
      std::ranges::any_of(times, [](const KeyedTime& time) { return varies(time.function); });
  const std::string& first = times.front().key;
  s.rule(changes, first.substr(0, first.find('.')),
         fmt::format("nothing changes with time, as analysis.type: path requires; give {}: {{type: ramp}}",
                     first));
}

}  // namespace

void declare_swept_key(Section& s, SweptKey& swept) {
  s.text("key", swept.key, "path of a key of this case, as written after --set");
  s.texts("values", swept.values, "values that the key takes in turn");
  s.rule(!swept.key.empty(), "key", "must be given");
  s.rule(!swept.values.empty(), "values", "must hold at least one value");
}

void declare_case(Section& s, Case& the_case) {
  s.text("title", the_case.title, "one line, for reports and pictures");
  s.section("geometry", the_case.geometry, "shape and bond of the masonry", declare_geometry);
  s.optional_section("imperfections", the_case.geometry.imperfections,
                     "random deviations from the ideal geometry", declare_imperfections);
  s.section("material", the_case.material, "weight of the blocks", declare_material);
  s.section("joints", the_case.joints, "contact laws of the joints", declare_joints);
  s.section("contact", the_case.contact, "contact detection", declare_contact);
  s.section("loads", the_case.loads, "gravity and other loads", declare_loads);
  s.section("ties", the_case.ties, "ties between two blocks", declare_ties);
  s.section("supports", the_case.supports, "motion imposed on fixed blocks", declare_supports);
  the_case.analysis.duration = default_duration(the_case);
  s.section("analysis", the_case.analysis, "type of analysis, method and accuracy", declare_analysis);
  s.rule(the_case.supports.restraints.empty() || the_case.analysis.type != AnalysisType::staged, "supports",
         "restraints are not part of the stages of construction: remove supports.restraints");
  declare_heat_rules(s, the_case);
  declare_path_rule(s, the_case);
  declare_pull_rule(s, the_case);
  declare_thickness_rule(s, the_case);
  s.section("output", the_case.output, "what is written during the analysis", declare_output);
  s.section("postproc", the_case.postproc, "meridians, sections and planes to evaluate", declare_postproc);
  declare_strength_rules(s, the_case);
  expect_face_loads(s, the_case);
  s.list_or_section("sweep", the_case.sweep, declare_swept_key, the_case.sample_file, declare_sample_file,
                    "parameter study: keys and the values they take, in all combinations");
  std::set<std::string> swept;
  s.rule(std::ranges::all_of(the_case.sweep, [&](const SweptKey& k) { return swept.insert(k.key).second; }),
         "sweep", "names a key twice");
  s.optional_section("ensemble", the_case.ensemble, "random members: distributions of keys",
                     declare_ensemble);
  s.rule(!the_case.ensemble || (the_case.sweep.empty() && the_case.sample_file.file.empty()), "ensemble",
         "and `sweep` exclude each other");
}

}  // namespace cupola
