#include "assembly/case/case_times.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cupola {

std::vector<KeyedTime> times_of(const Case& scene) {
  std::vector<KeyedTime> times;
  const auto add = [&times](const char* key, const auto& list) {
    for (size_t i = 0; i < list.size(); ++i)
      times.push_back({fmt::format("{}[{}].time", key, i), list[i].time});
  };
  add("supports.moves", scene.supports.moves);
  add("loads.forces", scene.loads.forces);
  add("loads.faces", scene.loads.faces);
  add("loads.heat", scene.loads.heat);
  times.push_back({"loads.dead_load_time", scene.loads.dead_load_time});
  times.push_back({"joints.friction_time", scene.joints.friction_time});
  return times;
}

std::vector<std::string> unused_times(const Case& scene) {
  const Analysis& analysis = scene.analysis;
  std::vector<std::string> out;
  if (analysis.type == AnalysisType::dynamic || analysis.type == AnalysisType::path) return out;
  const bool spread =
      analysis.type == AnalysisType::limit && analysis.limit.parameter == LimitSearch::Parameter::spread;
  std::vector<std::string> values;
  for (const KeyedTime& time : times_of(scene))
    if (varies(time.function) && !(spread && time.key.starts_with("supports.moves")))
      values.push_back(fmt::format("{} = {:g}", time.key, factor_at(time.function, 0.0)));
  if (!values.empty())
    out.push_back(fmt::format(
        "{} at the time 0, which is all that analysis.type: {} uses; leave this out for the full value, "
        "or use type: path",
        fmt::join(values, ", "), to_string(analysis.type)));
  if (scene.supports.base_motion)
    out.push_back(fmt::format("supports.base_motion: analysis.type: {} leaves it out; use type: dynamic",
                              to_string(analysis.type)));
  return out;
}

}  // namespace cupola
