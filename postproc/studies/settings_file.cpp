#include "postproc/studies/settings_file.hpp"

#include <algorithm>
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
  for (std::string setting; words >> setting;) {
    if (setting.find('=') == std::string::npos || setting.front() == '=')
      throw InputError(where, fmt::format("{}: must have the form key.path=value", setting));
    point.settings.push_back(setting);
  }
  return point;
}

}  // namespace

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
  for (size_t i = 0; i < points.size(); ++i) {
    const StudyPoint* reference = find_point(points, points[i].reference);
    if (!reference || !reference->is_reference())
      throw InputError(places[i],
                       fmt::format("{}: no line defines {} as a reference, that is, with itself as reference",
                                   points[i].name, points[i].reference));
  }
  return points;
}

}  // namespace cupola
