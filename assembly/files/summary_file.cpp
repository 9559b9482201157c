#include "assembly/files/summary_file.hpp"

#include <concepts>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSummaryFormatVersion = 3, kOldestSummaryFormat = 2;

/// The keys of summary.json, listed once for writing and reading.
template <class SummaryType, class Visit>
void for_each_field(SummaryType& s, Visit visit) {
  visit("status", s.status);
  visit("message", s.message);
  visit("forces_unique", s.forces_unique);
  visit("analysis", s.analysis);
  visit("method", s.method);
  visit("friction_law", s.friction_law);
  visit("dilatancy", s.dilatancy);
  visit("tangential", s.tangential);
  visit("program_version", s.program_version);
  visit("case_hash", s.case_hash);
  visit("geometry_hash", s.geometry_hash);
  visit("assembly_hash", s.assembly_hash);
  visit("blocks", s.blocks);
  visit("free_blocks", s.free_blocks);
  visit("joints", s.joints);
  visit("contacts", s.contacts);
  visit("unknowns", s.unknowns);
  visit("weight_N", s.weight_N);
  visit("applied_load_N", s.applied_load_N);
  visit("support_reaction_N", s.support_reaction_N);
  visit("time_step_s", s.time_step_s);
  visit("accuracy", s.accuracy);
  visit("momentum_residual", s.momentum_residual);
  visit("equilibrium_residual", s.equilibrium_residual);
  visit("inertia_share", s.inertia_share);
  visit("energy_error", s.energy_error);
  visit("contact_law_residual", s.contact_law_residual);
  visit("largest_law_violation", s.largest_law_violation);
  visit("certified_force_error", s.certified_force_error);
  visit("worst_steps", s.worst_steps);
  visit("friction_cone_violation", s.friction_cone_violation);
  visit("max_penetration_m", s.max_penetration_m);
  visit("max_displacement_m", s.max_displacement_m);
  visit("max_speed_m_per_s", s.max_speed_m_per_s);
  visit("slipping_contacts", s.slipping_contacts);
  visit("steps", s.steps);
  visit("iterations", s.iterations);
  visit("solve_time_seconds", s.solve_time_seconds);
  visit("wall_time_seconds", s.wall_time_seconds);
  visit("cpu_time_seconds", s.cpu_time_seconds);
  visit("peak_memory_bytes", s.peak_memory_bytes);
  visit("threads", s.threads);
  visit("robustness", s.robustness);
  visit("warnings", s.warnings);
}

template <class T>
Json to_value(const T& value) {
  return value;
}
template <NamedEnum E>
Json to_value(const E& value) {
  return to_string(value);
}
Json to_value(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
Json to_value(const Accuracy& accuracy) {
  return {{"quantity", accuracy.quantity},
          {"norm", accuracy.norm},
          {"asked", accuracy.asked},
          {"reached", accuracy.reached},
          {"worst_over_run", accuracy.worst_over_run}};
}
Json to_value(const ForceCertificate& certificate) {
  if (!certificate.value) return {{"not_certified", certificate.bounds}};
  return {{"value", *certificate.value}, {"bounds", certificate.bounds}};
}
Json to_value(const LawViolation& violation) {
  return {{"value", violation.value},
          {"joint", violation.joint},
          {"block_a", violation.block_a},
          {"block_b", violation.block_b},
          {"time_s", violation.time}};
}
Json to_value(const WorstSteps& worst) {
  Json json = Json::object();
  const auto add = [&json](const char* key, const std::optional<RunStep>& at) {
    if (at) json[key] = {{"step", at->step}, {"time_s", at->time}};
  };
  add("momentum_residual", worst.momentum_residual);
  add("contact_law_residual", worst.contact_law_residual);
  add("certified_force_error", worst.certified_force_error);
  return json;
}
Json to_value(const Robustness& robustness) {
  return {{"directions", robustness.directions},
          {"acceleration_g", robustness.acceleration_g},
          {"moving_g", robustness.moving_g},
          {"azimuth_deg", robustness.azimuth_deg}};
}
Json to_value(const ForcesUnique& unique) {
  return {{"value", unique.value}, {"reason", unique.reason}};
}
Json to_value(const PartVerdict& part) {
  return {{"first_block", part.first_block}, {"blocks", part.blocks}, {"status", to_string(part.status)}};
}

Json to_value(const RangeEnd& end) {
  Json json = {{"outcome", to_string(end.outcome)}};
  if (end.value) json["value"] = *end.value;
  if (end.bound) json["bound"] = *end.bound;
  if (end.frame) json["frame"] = *end.frame;
  return json;
}
Json to_value(const ForceRange& range) {
  Json json = {{"quantity", range.quantity},
               {"unit", range.unit},
               {"min", to_value(range.min)},
               {"max", to_value(range.max)}};
  if (range.joint) json["joint"] = {range.joint->first, range.joint->second};
  if (range.chosen) json["chosen"] = *range.chosen;
  return json;
}

/// JSON has no infinities and NaN: they are written as null and read back as NaN.
void from_value(const Json& json, double* value) {
  *value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}
void from_value(const Json& json, Vec3* v) {
  for (int i = 0; i < 3; ++i) from_value(json.at(static_cast<size_t>(i)), &(*v)[i]);
}
template <NamedEnum E>
void from_value(const Json& json, E* value) {
  const std::optional<E> known = enum_from_name<E>(json.get<std::string>());
  if (!known) throw InputError("unknown name");
  *value = *known;
}
void from_value(const Json& json, std::string* value) {
  json.get_to(*value);
}
void from_value(const Json& json, std::vector<std::string>* value) {
  json.get_to(*value);
}
void from_value(const Json& json, Accuracy* accuracy) {
  from_value(json.at("quantity"), &accuracy->quantity);
  from_value(json.at("norm"), &accuracy->norm);
  from_value(json.at("asked"), &accuracy->asked);
  from_value(json.at("reached"), &accuracy->reached);
  from_value(json.at("worst_over_run"), &accuracy->worst_over_run);
}
void from_value(const Json& json, ForceCertificate* certificate) {
  const bool certified = json.contains("value");
  certificate->value.reset();
  if (certified) from_value(json["value"], &certificate->value.emplace());
  from_value(json.at(certified ? "bounds" : "not_certified"), &certificate->bounds);
}
void from_value(const Json& json, ForcesUnique* unique) {
  json.at("value").get_to(unique->value);
  from_value(json.at("reason"), &unique->reason);
}
/// The JSON library would silently truncate fractions and numbers out of range.
template <std::integral T>
void from_value(const Json& json, T* value) {
  const bool fits = json.is_number_unsigned()
                        ? std::in_range<T>(json.get<std::uint64_t>())
                        : json.is_number_integer() && std::in_range<T>(json.get<std::int64_t>());
  if (!fits) throw InputError("not a whole number in range");
  json.get_to(*value);
}
void from_value(const Json& json, LawViolation* violation) {
  from_value(json.at("value"), &violation->value);
  from_value(json.at("joint"), &violation->joint);
  from_value(json.at("block_a"), &violation->block_a);
  from_value(json.at("block_b"), &violation->block_b);
  from_value(json.at("time_s"), &violation->time);
}
void from_value(const Json& json, WorstSteps* worst) {
  const auto read = [&json](const char* key, std::optional<RunStep>* at) {
    if (!json.contains(key)) return;
    at->emplace();
    from_value(json[key].at("step"), &(*at)->step);
    from_value(json[key].at("time_s"), &(*at)->time);
  };
  read("momentum_residual", &worst->momentum_residual);
  read("contact_law_residual", &worst->contact_law_residual);
  read("certified_force_error", &worst->certified_force_error);
}
void from_value(const Json& json, Robustness* robustness) {
  from_value(json.at("directions"), &robustness->directions);
  from_value(json.at("acceleration_g"), &robustness->acceleration_g);
  from_value(json.at("moving_g"), &robustness->moving_g);
  from_value(json.at("azimuth_deg"), &robustness->azimuth_deg);
}
void from_value(const Json& json, PartVerdict* part) {
  from_value(json.at("first_block"), &part->first_block);
  from_value(json.at("blocks"), &part->blocks);
  from_value(json.at("status"), &part->status);
}
template <class T>
void read_optional(const Json& json, const char* key, std::optional<T>* value) {
  if (json.contains(key)) from_value(json.at(key), &value->emplace());
}
void from_value(const Json& json, RangeEnd* end) {
  from_value(json.at("outcome"), &end->outcome);
  read_optional(json, "value", &end->value);
  read_optional(json, "bound", &end->bound);
  read_optional(json, "frame", &end->frame);
}
void from_value(const Json& json, ForceRange* range) {
  from_value(json.at("quantity"), &range->quantity);
  from_value(json.at("unit"), &range->unit);
  from_value(json.at("min"), &range->min);
  from_value(json.at("max"), &range->max);
  if (json.contains("joint")) json["joint"].get_to(range->joint.emplace());
  read_optional(json, "chosen", &range->chosen);
}

}  // namespace

std::string to_json(const Summary& summary) {
  Json json;
  json["format_version"] = kSummaryFormatVersion;
  for_each_field(summary, [&json](const char* key, const auto& value) {
    if constexpr (requires { value.has_value(); }) {
      if (value) json[key] = to_value(*value);  // absent without a value
    } else {
      json[key] = to_value(value);
    }
  });
  if (const auto& critical = summary.critical) {
    json["critical_parameter"] = critical->parameter;
    json["critical_value"] = critical->value;
    json["bracket"] = {critical->stable, critical->moving};
  }
  for (const ForceRange& range : summary.ranges) json["ranges"].push_back(to_value(range));
  for (const PartVerdict& part : summary.parts) json["parts"].push_back(to_value(part));
  json["text_files"] = summary.text_files;
  return json.dump(2) + "\n";
}

std::string to_json(const Interruption& interruption) {
  const Json json = {{"program_version", interruption.program_version},
                     {"case_hash", interruption.case_hash},
                     {"assembly_hash", interruption.assembly_hash},
                     {"resumable", interruption.resumable},
                     {"frames", interruption.frames},
                     {"last_line", interruption.last_line},
                     {"wall_time_seconds", interruption.wall_time_seconds}};
  return json.dump(2) + "\n";
}

Summary summary_from_json(const std::string& text, const std::string& file) {
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object())
    throw InputError(FileLocation{file}, "is not a complete JSON object: damaged, or not a summary");
  if (const Json version = json.value("format_version", Json());
      !version.is_number_integer() || version < kOldestSummaryFormat || version > kSummaryFormatVersion)
    throw InputError(
        FileLocation{file},
        fmt::format("has format_version {}, this program reads versions {} to {}; run cupola-solve again",
                    version.dump(), kOldestSummaryFormat, kSummaryFormatVersion));
  Summary summary;
  for_each_field(summary, [&](const char* key, auto& value) {
    constexpr bool is_optional = requires {
      value.has_value();
    };
    if (!json.contains(key)) {
      if (is_optional) return;
      throw InputError(FileLocation{file}, fmt::format("key `{}` is missing", key));
    }
    try {
      if constexpr (is_optional)
        from_value(json[key], &value.emplace());
      else
        from_value(json[key], &value);
    } catch (const std::exception&) {
      throw InputError(FileLocation{file},
                       fmt::format("{} = {}: has the wrong type or an unknown value", key, json[key].dump()));
    }
  });
  if (json.contains("critical_value")) {
    try {
      summary.critical = CriticalValue{json.at("critical_parameter"), json.at("critical_value"),
                                       json.at("bracket").at(0), json.at("bracket").at(1)};
    } catch (const std::exception&) {
      throw InputError(FileLocation{file},
                       "critical_value: parameter or bracket is missing or has the wrong type");
    }
  }
  try {
    for (const Json& range : json.value("ranges", Json::array()))
      from_value(range, &summary.ranges.emplace_back());
  } catch (const std::exception&) {
    throw InputError(FileLocation{file}, "ranges: a key is missing or has the wrong type");
  }
  try {
    for (const Json& part : json.value("parts", Json::array()))
      from_value(part, &summary.parts.emplace_back());
  } catch (const std::exception&) {
    throw InputError(FileLocation{file}, "parts: a key is missing or has the wrong type");
  }
  try {
    if (json.contains("text_files")) json["text_files"].get_to(summary.text_files);
  } catch (const std::exception&) {
    throw InputError(FileLocation{file}, "text_files: must be a map from file names to hashes");
  }
  return summary;
}

}  // namespace cupola
