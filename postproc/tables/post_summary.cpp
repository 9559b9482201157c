#include "postproc/tables/post_summary.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/base/variant.hpp"
#include "assembly/files/atomic_file.hpp"
#include "postproc/evaluation/margin.hpp"
#include "postproc/evaluation/thrust.hpp"
#include "postproc/tables/observed_cracks.hpp"
#include "postproc/tables/result_columns.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormatVersion = 2;

/// The keys that describe a run, in one list for writing and reading.
template <class SummaryType, class Visit>
void for_each_field(SummaryType& s, Visit visit) {
  visit("title", s.title);
  visit("status", s.status);
  visit("friction_law", s.friction_law);
  visit("program_version", s.program_version);
  visit("blocks", s.blocks);
  visit("weight_N", s.weight_N);
  visit("block_size_m", s.block_size_m);
  visit("friction", s.friction);
  visit("equilibrium_residual", s.equilibrium_residual);
  visit("negligible_force_N", s.negligible_force_N);
  visit("largest_ring_difference", s.largest_ring_difference);
  visit("mean_cv_pressure", s.mean_cv_pressure);
  visit("largest_cv_pressure", s.largest_cv_pressure);
  visit("rib_over_mid_sail", s.rib_over_mid_sail);
  visit("rib_over_mid_sail_smallest", s.rib_over_mid_sail_smallest);
  visit("rib_over_mid_sail_largest", s.rib_over_mid_sail_largest);
  visit("compliance_per", s.compliance_per);
  visit("points_per_base_joint", s.points_per_base_joint);
  visit("largest_couple_length_m", s.largest_couple_length_m);
  visit("largest_friction_use", s.largest_friction_use);
  visit("largest_pressure_Pa", s.largest_pressure_Pa);
  visit("largest_strength_use", s.largest_strength_use);
  visit("crack_length_m", s.crack_length_m);
  visit("widest_crack_m", s.widest_crack_m);
  visit("mean_kern_use", s.mean_kern_use);
  visit("thrust_over_weight", s.thrust_over_weight);
  visit("max_displacement_m", s.max_displacement_m);
  visit("critical_value", s.critical_value);
  visit("critical_unit", s.critical_unit);
  visit("margin_factor", s.margin_factor);
}

Json to_value(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}
template <class T>
Json to_value(const T& value) {
  return value;
}

void from_value(const Json& json, std::optional<double>* value) {
  value->reset();
  if (!json.is_null()) *value = json.get<double>();
}
void from_value(const Json& json, double* value) {
  *value = json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}
template <class T>
void from_value(const Json& json, T* value) {
  json.get_to(*value);
}

Json to_json(const Value& value) {
  return std::visit(
      Overloaded{[](const Vec3& v) {
                   return Json{v.x(), v.y(), v.z()};
                 },
                 [](double number) { return Json(number); }, [](int number) { return Json(number); },
                 [](const std::string& text) { return Json(text); },
                 [](auto kind) { return Json(to_string(kind)); }},
      value);
}

Json rings_json(const Evaluation& e) {
  Json rings = Json::array();
  for (const RingSum& cut : e.rings) {
    if (cut.blocks == 0) continue;
    Json& ring = rings.emplace_back();
    for (const char* key : kRingSummaryKeys)
      ring[key] = to_json(column_named(ring_columns(), key).value(cut));
  }
  return rings;
}

Json chains_json(const Evaluation& e) {
  Json chains = Json::array();
  for (const ChainForces& row : e.chains) {
    Json& chain = chains.emplace_back();
    for (const char* key : kChainSummaryKeys)  // infinities become null
      chain[key] = to_json(column_named(chain_columns(), key).value(row));
  }
  return chains;
}

Json ranges_json(const std::vector<ForceRange>& ranges) {
  Json list = Json::array();
  for (const ForceRange& range : ranges) {
    Json& entry = list.emplace_back();
    for (const char* key : kRangeSummaryKeys)  // infinities and NaN become null
      entry[key] = to_json(column_named(range_columns(), key).value(range));
  }
  return list;
}

RangeEnd end_of(const Json& entry, const std::string& end) {
  RangeEnd out;
  const auto outcome = enum_from_name<RangeOutcome>(entry.at(end + "_outcome").get<std::string>());
  if (!outcome) throw InputError(end + "_outcome: unknown name");
  out.outcome = *outcome;
  from_value(entry.at(end), &out.value);
  from_value(entry.at(end + "_bound"), &out.bound);
  if (const int frame = entry.at(end + "_frame").get<int>(); frame >= 0) out.frame = frame;
  return out;
}

void from_value(const Json& json, std::vector<ForceRange>* ranges) {
  for (const Json& entry : json) {
    ForceRange& range = ranges->emplace_back();
    entry.at("quantity").get_to(range.quantity);
    entry.at("unit").get_to(range.unit);
    range.min = end_of(entry, "min");
    range.max = end_of(entry, "max");
    from_value(entry.at("chosen"), &range.chosen);
    if (const int block_a = entry.at("block_a").get<int>(); block_a >= 0)
      range.joint = std::pair{block_a, entry.at("block_b").get<int>()};
  }
}

std::optional<double> points_per_base_joint(const JointWrenches& joints) {
  int points = 0, count = 0;
  for (const JointWrench& joint : joints.wrenches) {
    if (joint.kind != JointKind::base) continue;
    points += joint.num_contacts;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return static_cast<double>(points) / count;
}

/// Numbers that interpret the forces of an equilibrium. Joints without them have NaN, which fmax skips.
void add_equilibrium(const Evaluation& e, PostSummary* s) {
  const auto raise = [](std::optional<double>* largest, double value) {
    *largest = std::fmax(largest->value_or(0.0), value);
  };
  const auto rings =
      std::count_if(e.rings.begin(), e.rings.end(), [](const RingSum& r) { return r.blocks > 0; });
  for (const RingSum& r : e.rings) {
    if (r.blocks == 0) continue;
    raise(&s->largest_ring_difference, r.relative_difference);
    s->mean_cv_pressure = s->mean_cv_pressure.value_or(0.0) + r.cv_pressure / static_cast<double>(rings);
    raise(&s->largest_cv_pressure, r.cv_pressure);
  }
  double kern = 0.0, force = 0.0;
  for (const JointWrench& joint : e.last.joints.wrenches) {
    raise(&s->largest_friction_use, joint.friction_use);
    raise(&s->largest_pressure_Pa, joint.largest_pressure);
    if (!std::isnan(joint.strength_use)) raise(&s->largest_strength_use, joint.strength_use);
    if (joint.upper < 0 || std::isnan(joint.kern)) continue;
    kern += joint.normal_force * joint.kern;
    force += joint.normal_force;
  }
  if (force > 0.0) s->mean_kern_use = above(kern / force, e.last.joints.floor.share);
  if (!is_rigid(e) && !supports_have_not_moved(e)) {
    s->crack_length_m = s->widest_crack_m = 0.0;
    for (const ShellCrack& crack : e.cracks) {
      *s->crack_length_m += crack.length;
      raise(&s->widest_crack_m, crack.width);
    }
  }
  if (!e.scene.analysis.plane)  // where no couple turns about the force
    for (const BlockFields& f : e.last.fields) raise(&s->largest_couple_length_m, f.couple_length);
  if (const auto thrust = outward_thrust(e); thrust && e.summary.weight_N > 0.0)
    s->thrust_over_weight = *thrust / e.summary.weight_N;
  if (e.rib_over_mid_sail) {
    s->rib_over_mid_sail = e.rib_over_mid_sail->mean;
    s->rib_over_mid_sail_smallest = e.rib_over_mid_sail->smallest;
    s->rib_over_mid_sail_largest = e.rib_over_mid_sail->largest;
  }
  for (const MeridianEvaluation& m : e.meridians)
    s->thrust_lines.push_back({m.thrust.name, m.thrust.undefined + m.thrust.without_skins, m.thrust.inside,
                               m.thrust.least_face_distance, m.thrust.least_geometric_safety});
}

}  // namespace

PostSummary post_summary(const Evaluation& e) {
  PostSummary s;
  s.title = e.scene.title;
  s.status = to_string(e.summary.status);
  s.friction_law = to_string(e.summary.friction_law);
  s.program_version = program_version();
  s.blocks = e.summary.free_blocks;
  s.weight_N = e.summary.weight_N;
  s.block_size_m = block_size(e.assembly);
  s.negligible_force_N = e.last.joints.floor.force;
  s.friction = e.scene.joints.friction;
  s.equilibrium_residual = e.summary.equilibrium_residual.value_or(std::numeric_limits<double>::infinity());
  if (const auto& critical = e.summary.critical) {
    s.critical_value = critical->value;
    s.critical_parameter = critical->parameter;
    s.critical_unit = limit_unit(critical->parameter);
    s.margin_factor = factor_of_safety(e.scene, e.summary);
  }
  s.max_displacement_m = e.summary.max_displacement_m;
  s.compliance_per = is_rigid(e) ? "none" : to_string(e.scene.joints.compliance.per);
  s.points_per_base_joint = points_per_base_joint(e.last.joints);
  if (e.scene.analysis.plane && s.points_per_base_joint) *s.points_per_base_joint /= 2.0;  // spread over two
  s.ranges = e.summary.ranges;
  if (at_rest(e)) add_equilibrium(e, &s);
  return s;
}

std::string post_summary_json(const Evaluation& e) {
  const PostSummary s = post_summary(e);
  Json json;
  json["format_version"] = kFormatVersion;
  for_each_field(s, [&json](const char* key, const auto& value) { json[key] = to_value(value); });
  json["critical_parameter"] = s.critical_parameter;
  json["assembly_hash"] = e.summary.assembly_hash;
  json["case_hash"] = e.summary.case_hash;
  json["time_s"] = e.last.frame.time;
  json["frames"] = e.times.size();
  json["lost_joints"] = e.lost_joints ? Json(*e.lost_joints) : Json();
  json["warnings"] = notices(e);
  if (const auto observed = crack_agreement(e)) {
    json["crack_agreement"] = observed->agreement;
    json["crack_agreement_by_chance"] = observed->by_chance;
  }
  json["thrust_lines"] = Json::array();
  for (const PostSummary::Line& line : s.thrust_lines)
    json["thrust_lines"].push_back({{"name", line.name},
                                    {"undefined_beds", line.undefined},
                                    {"inside", line.inside},
                                    {"least_face_distance_m", line.least_face_distance_m},
                                    {"least_geometric_safety", line.least_geometric_safety}});
  json["planes"] = Json::array();
  for (const PlaneCut& cut : e.planes)
    json["planes"].push_back(
        {{"name", cut.name},
         {"through_N", cut.across.force.dot(cut.normal)},
         {"along_N", (cut.across.force - cut.across.force.dot(cut.normal) * cut.normal).norm()},
         {"ties_N", cut.from_ties.dot(cut.normal)},
         {"relative_difference", cut.relative_difference}});
  json["ranges"] = ranges_json(s.ranges);
  json["rings"] = rings_json(e);
  json["chains"] = chains_json(e);
  return json.dump(2) + "\n";
}

PostSummary read_post_summary(const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / "summary.json").string();
  if (!std::filesystem::exists(path))
    throw InputError(FileLocation{path},
                     "does not exist: expected a folder written by `cupola-post analyse`");
  const Json json = Json::parse(read_text(path), nullptr, /*allow_exceptions=*/false);
  PostSummary s;
  s.folder = folder;
  if (!json.is_object())
    throw InputError(FileLocation{path}, "is not a complete JSON object: run `cupola-post analyse` again");
  if (json.value("format_version", 0) != kFormatVersion || !json.contains("thrust_lines"))
    throw InputError(FileLocation{path},
                     "was not written by this version of `cupola-post analyse`: run it again");
  const auto read = [&path](const Json& from, const char* key, auto* value) {
    try {
      from_value(from.at(key), value);
    } catch (const std::exception&) {
      throw InputError(FileLocation{path}, fmt::format("key `{}` is missing or has the wrong type", key));
    }
  };
  for_each_field(s, [&](const char* key, auto& value) { read(json, key, &value); });
  if (json.contains("critical_parameter"))  // version 0.4 did not write it
    read(json, "critical_parameter", &s.critical_parameter);
  for (const Json& entry : json["thrust_lines"]) {
    PostSummary::Line line;
    read(entry, "name", &line.name);
    read(entry, "undefined_beds", &line.undefined);
    read(entry, "inside", &line.inside);
    read(entry, "least_face_distance_m", &line.least_face_distance_m);
    read(entry, "least_geometric_safety", &line.least_geometric_safety);
    s.thrust_lines.push_back(std::move(line));
  }
  read(json, "ranges", &s.ranges);
  return s;
}

}  // namespace cupola
