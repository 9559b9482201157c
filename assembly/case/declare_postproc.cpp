#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

void declare_meridian(Section& s, Meridian& meridian) {
  s.text("name", meridian.name, "its name in files and figures");
  s.number("azimuth_deg", meridian.azimuth_deg, {.unit = "deg", .min = -360, .max = 360},
           "half-plane of a meridian, from x towards y");
}

}  // namespace

void declare_output(Section& s, Output& output) {
  s.number("frames_every", output.frames_every, {.unit = "s", .above = 0}, "dynamic: time between frames");
}

void declare_postproc(Section& s, Postproc& postproc) {
  s.list("meridians", postproc.meridians, "meridians to draw thrust lines in", declare_meridian);
  s.numbers("sections", postproc.sections, {.unit = "m"}, "heights of horizontal sections");
}

}  // namespace cupola
