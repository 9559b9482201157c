#include "assembly/files/summary_file.hpp"

#include <concepts>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "assembly/base/error.hpp"
#include "assembly/records/summary_record.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSummaryFormatVersion = 3, kOldestSummaryFormat = 2;

template <class T>
concept MayBeEmpty = requires(T x) {
  x.has_value();
};
template <class T>
constexpr bool kIsListOfRecords = false;
template <Record R>
constexpr bool kIsListOfRecords<std::vector<R>> = true;

/// Values that a run does not have, lists of records that are empty, and (in old files) text_files have no
/// key.
template <class T>
constexpr bool kMayBeAbsent = MayBeEmpty<T> || kIsListOfRecords<T> || requires {
  typename T::mapped_type;
};

template <class T>
Json json_of(const T& value);

template <Record R>
void add_fields(const R& record, Json* json) {
  const auto add = [json]<class M>(const char* key, const char*, const char*, const M& member) {
    if constexpr (MayBeEmpty<M>)
      if (!member.has_value()) return;
    if constexpr (kIsListOfRecords<M>)
      if (member.empty()) return;
    (*json)[key] = json_of(member);
  };
  fields(add, record);
}

template <class T>
Json json_of(const T& value) {
  if constexpr (Record<const T>) {
    Json json = Json::object();
    add_fields(value, &json);
    return json;
  } else if constexpr (MayBeEmpty<T>) {
    return json_of(*value);
  } else if constexpr (NamedEnum<T>) {
    return to_string(value);
  } else if constexpr (std::same_as<T, Vec3>) {
    return {value.x(), value.y(), value.z()};
  } else if constexpr (kIsListOfRecords<T>) {
    Json list = Json::array();
    for (const auto& element : value) list.push_back(json_of(element));
    return list;
  } else {
    return value;
  }
}
/// Throws std::exception for a missing key, a wrong type or an unknown name.
template <class T>
void read_value(const Json& json, T* value) {
  if constexpr (Record<T>) {
    fields(
        [&json]<class M>(const char* key, const char*, const char*, M& member) {
          if (!kMayBeAbsent<M> || json.contains(key)) read_value(json.at(key), &member);
        },
        *value);
  } else if constexpr (MayBeEmpty<T>) {
    read_value(json, &value->emplace());
  } else if constexpr (NamedEnum<T>) {
    const std::optional<T> known = enum_from_name<T>(json.get<std::string>());
    if (!known) throw InputError("unknown name");
    *value = *known;
  } else if constexpr (std::same_as<T, double>) {  // JSON has no infinities and NaN: they are written as null
    *value = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
  } else if constexpr (std::same_as<T, Vec3>) {
    for (int i = 0; i < 3; ++i) read_value(json.at(static_cast<size_t>(i)), &(*value)[i]);
  } else if constexpr (kIsListOfRecords<T>) {
    if (!json.is_array()) throw InputError("not a list");
    for (const Json& element : json) read_value(element, &value->emplace_back());
  } else {
    if constexpr (std::integral<T> && !std::same_as<T, bool>) {
      // The JSON library would silently truncate fractions and numbers out of range.
      const bool fits = json.is_number_unsigned()
                            ? std::in_range<T>(json.get<std::uint64_t>())
                            : json.is_number_integer() && std::in_range<T>(json.get<std::int64_t>());
      if (!fits) throw InputError("not a whole number in range");
    }
    json.get_to(*value);
  }
}

}  // namespace

std::string to_json(const Summary& summary) {
  Json json = {{"format_version", kSummaryFormatVersion}};
  add_fields(summary, &json);
  if (const auto& critical = summary.critical) {
    json["critical_parameter"] = critical->parameter;
    json["critical_value"] = critical->value;
    json["bracket"] = {critical->stable, critical->moving};
  }
  return json.dump(2) + "\n";
}

std::string to_json(const Interruption& interruption) {
  return json_of(interruption).dump(2) + "\n";
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
  fields(
      [&]<class M>(const char* key, const char*, const char*, M& member) {
        if (!json.contains(key)) {
          if (kMayBeAbsent<M>) return;
          throw InputError(FileLocation{file}, fmt::format("key `{}` is missing", key));
        }
        try {
          read_value(json[key], &member);
        } catch (const std::exception&) {
          throw InputError(FileLocation{file}, fmt::format("{} = {}: has the wrong type or an unknown value",
                                                           key, json[key].dump()));
        }
      },
      summary);
  if (json.contains("critical_value")) {
    try {
      summary.critical = CriticalValue{json.at("critical_parameter"), json.at("critical_value"),
                                       json.at("bracket").at(0), json.at("bracket").at(1)};
    } catch (const std::exception&) {
      throw InputError(FileLocation{file},
                       "critical_value: parameter or bracket is missing or has the wrong type");
    }
  }
  return summary;
}

}  // namespace cupola
