#include <algorithm>
#include <cctype>

#include "assembly/case/declare.hpp"
#include "assembly/files/seen_cracks.hpp"

namespace cupola {
namespace {

/// These names become parts of file names.
void declare_name(Section& s, std::string& name) {
  s.text("name", name, "name in files and figures: letters, digits, _ and -");
  s.rule(std::all_of(name.begin(), name.end(),
                     [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; }),
         "name", "may contain only letters, digits, _ and -");
}

void declare_meridian(Section& s, Meridian& meridian) {
  declare_name(s, meridian.name);
  s.number("azimuth_deg", meridian.azimuth_deg, {.unit = "deg", .min = -360, .max = 360},
           "azimuth of the meridian's half-plane, from x towards y");
}

void declare_plane(Section& s, CutPlane& plane) {
  declare_name(s, plane.name);
  s.vector3("point", plane.point, {.unit = "m"}, "a point of the plane");
  s.vector3("normal", plane.normal, {}, "normal of any length, towards the side that counts as beyond");
  s.rule(plane.normal.norm() > 0.0, "normal", "must not be zero");
}

/// Files and figures of two parts of one name would overwrite each other.
template <class Named>
bool names_differ(const std::vector<Named>& parts) {
  std::vector<std::string> names;
  for (const Named& part : parts) names.push_back(part.name);
  std::ranges::sort(names);
  return std::ranges::adjacent_find(names) == names.end();
}

}  // namespace

void declare_output(Section& s, Output& output) {
  s.number("frames_every", output.frames_every, {.unit = "s", .above = 0},
           "dynamic: time between result frames, each at the end of the step that reaches it");
}

void declare_postproc(Section& s, Postproc& postproc) {
  s.list("meridians", postproc.meridians, "meridians in which thrust lines are drawn", declare_meridian);
  s.rule(names_differ(postproc.meridians), "meridians", "two meridians have the same name");
  s.numbers("sections", postproc.sections, {.unit = "m"}, "heights of horizontal sections");
  s.list("planes", postproc.planes, "planes of any direction: the force transmitted across each",
         declare_plane);
  s.file("observed", postproc.observed,
         "cracks seen on the building, with which those of the run are compared: a CSV file with the columns "
         "azimuth_deg and width_m (0: none)");
  if (!postproc.observed.empty()) read_seen_cracks(postproc.observed);  // before any work is done
  s.rule(names_differ(postproc.planes), "planes", "two planes have the same name");
}

}  // namespace cupola
