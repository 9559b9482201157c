#include "postproc/studies/settings_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"

namespace cupola {
namespace {

const StudyPoint* find_point(const std::vector<StudyPoint>& points, const std::string& name) {
  const auto at =
      std::find_if(points.begin(), points.end(), [&](const StudyPoint& p) { return p.name == name; });
  return at == points.end() ? nullptr : &*at;
}

StudyPoint read_point(const std::string& line, const FileLocation& where) {
  std::istringstream words(line);
  StudyPoint point;
  if (!(words >> point.knob >> point.name >> point.reference))
    throw InputError(where, "expected KNOB NAME REFERENCE key.path=value ...");
  if (const size_t plus = point.reference.find('+'); plus != std::string::npos) {
    point.coarse = point.reference.substr(plus + 1);
    point.reference.resize(plus);
  }
  for (std::string setting; words >> setting;) {
    if (setting.find('=') == std::string::npos || setting.front() == '=')
      throw InputError(where, fmt::format("{}: must have the form key.path=value", setting));
    point.settings.push_back(setting);
  }
  return point;
}

/// The time step that a run sets, s; 0 if it sets none.
double time_step(const StudyPoint& point) {
  constexpr const char* kKey = "analysis.time_step=";
  for (const std::string& setting : point.settings)
    if (setting.starts_with(kKey)) return std::strtod(setting.c_str() + std::strlen(kKey), nullptr);
  return 0.0;
}

void check_reference(const StudyPoint& point, const std::vector<StudyPoint>& points,
                     const FileLocation& where) {
  const StudyPoint* reference = find_point(points, point.reference);
  if (point.coarse.empty()) {
    if (!reference || !reference->is_reference())
      throw InputError(where,
                       fmt::format("{}: no line defines {} as a reference, that is, with itself as reference",
                                   point.name, point.reference));
    return;
  }
  const StudyPoint* coarse = find_point(points, point.coarse);
  if (!reference || !coarse)
    throw InputError(
        where, fmt::format("{}: no line defines {}", point.name, reference ? point.coarse : point.reference));
  constexpr double kRounding = 1e-9;  // of decimal numbers read from text
  const double fine_step = time_step(*reference), coarse_step = time_step(*coarse);
  if (fine_step <= 0.0 || std::abs(coarse_step / fine_step - 2.0) > kRounding)
    throw InputError(
        where, fmt::format("{}: extrapolation requires that analysis.time_step of {} is twice that of {}",
                           point.name, point.coarse, point.reference));
}

}  // namespace

std::string StudyPoint::reference_text() const {
  return coarse.empty() ? reference : fmt::format("2 x {} - {}", reference, coarse);
}

std::vector<StudyPoint> read_study(const std::vector<std::string>& paths) {
  std::vector<StudyPoint> points;
  std::vector<FileLocation> places;
  for (const std::string& path : paths) {
    std::istringstream text(read_text(path));
    FileLocation where{path, 0, 0};
    for (std::string line; std::getline(text, line);) {
      ++where.line;
      const size_t first = line.find_first_not_of(" \t\r");
      if (first == std::string::npos || line[first] == '#') continue;
      StudyPoint point = read_point(line, where);
      if (find_point(points, point.name))
        throw InputError(where,
                         fmt::format("{}: another run has this name; names must be unique", point.name));
      points.push_back(std::move(point));
      places.push_back(where);
    }
  }
  if (points.empty()) throw InputError("the study files list no runs");
  for (size_t i = 0; i < points.size(); ++i) check_reference(points[i], points, places[i]);
  return points;
}

}  // namespace cupola
