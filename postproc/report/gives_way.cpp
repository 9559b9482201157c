#include "postproc/report/gives_way.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/place_text.hpp"

namespace cupola {
namespace {

/// "course 7 of barrel on wall (z = 4.5 m, slides)". `course`: of the assembly.
std::string course_text(const Evaluation& e, int course, const CourseMotion& motion) {
  const Sheet *sheet = e.assembly.sheet_of(course), *below = e.assembly.sheet_of(motion.on);
  std::string name = fmt::format("course {}", course);
  if (sheet && e.assembly.sheets.size() > 1) name += " of " + sheet->name;
  if (motion.on < 0)
    name += " on its support";
  else if (below && below != sheet)
    name += " on " + below->name;
  const double most = std::max({motion.hinging, motion.sliding, motion.parting});
  return fmt::format("{} (z = {} m, {})", name, place_text(motion.height, model_size(e.assembly)),
                     most == motion.hinging   ? "hinges"
                     : most == motion.sliding ? "slides"
                                              : "parts");
}

/// "; 60 % of the motion is at course 7 (z = 4.5 m, slides)": the courses that move most, until they make up
/// nearly all of the motion, at most five; "" without courses.
std::string moving_courses(const Evaluation& e, const MechanismMotion& motion) {
  constexpr double kEnough = 0.9;
  constexpr size_t kMost = 5;
  std::vector<std::pair<int, const CourseMotion*>> courses;
  for (const auto& [bed, at] : motion.by_course)
    if (bed.first >= 0 && bed.first < static_cast<int>(e.rings.size())) courses.emplace_back(bed.first, &at);
  std::ranges::stable_sort(courses, std::ranges::greater(),
                           [](const auto& entry) { return entry.second->sum(); });
  std::vector<std::string> names;
  double sum = 0.0;
  for (const auto& [course, at] : courses) {
    if (names.size() == kMost || sum >= kEnough * motion.sum()) break;
    sum += at->sum();
    names.push_back(course_text(e, course, *at));
  }
  return names.empty() ? ""
                       : fmt::format("; {:.0f} % of the motion is at {}", 100.0 * sum / motion.sum(),
                                     fmt::join(names, ", "));
}

/// "hinges form at 4 joints, 12 others slide": at a hinge it may slide, too.
std::string counts_text(const GivesWay& joints) {
  std::vector<std::string> parts;
  const auto add = [&parts](int count, const char* one, const char* many) {
    if (count > 0)
      parts.push_back(
          fmt::format("{} {}", counted(count, parts.empty() ? "joint" : "other"), count == 1 ? one : many));
  };
  if (joints.hinging > 0) parts.push_back("hinges form at " + counted(joints.hinging, "joint"));
  add(joints.sliding, "slides", "slide");
  add(joints.opening, "opens", "open");
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Degrees from the vertical at which the intrados of a course rises; none if the beds on which it stands are
/// not level.
std::optional<double> leaves_level_beds_at(const Assembly& assembly, int course) {
  constexpr double kLevel = 1e-9;
  double steepest = 0.0;
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces && part.ring == course; ++f) {
      const FaceKind kind = assembly.face_kinds[f];
      const double up = polygon_plane(face_points(assembly, f)).normal.z();
      const bool is_bed = kind == FaceKind::bed || kind == FaceKind::top;
      if (is_bed && up < 0.0 && up > -1.0 + kLevel) return std::nullopt;
      if (kind == FaceKind::intrados) steepest = std::max(steepest, std::asin(std::abs(up)));
    }
  return steepest * 180.0 / std::numbers::pi;
}

/// A vault that slides on the level beds of its springing, which its profile leaves at more than the angle of
/// friction: what builders do about it.
std::string missing_skewback(const Evaluation& e, const MechanismMotion& motion) {
  constexpr double kMuch = 0.1;  // of the motion
  for (const auto& [bed, at] : motion.by_course) {
    const int course = bed.first;
    const Sheet *sheet = e.assembly.sheet_of(course), *below = e.assembly.sheet_of(at.on);
    if (!sheet || !below || below == sheet) continue;
    if (course != sheet->first_ring && course != sheet->first_ring + sheet->num_rings - 1) continue;
    if (at.sliding < at.hinging || at.sliding < kMuch * motion.sum()) continue;
    const std::optional<double> angle = leaves_level_beds_at(e.assembly, course);
    if (angle && std::tan(*angle * std::numbers::pi / 180.0) > e.scene.joints.friction)
      return fmt::format(
          "; {} slides on level beds, which its profile leaves at {:.0f} degrees from the vertical, more "
          "than friction holds: see Skewbacks in docs/cases.md",
          sheet->name, *angle);
  }
  return "";
}

}  // namespace

std::string how_it_gives_way(const Evaluation& e) {
  if (!e.gives_way || e.gives_way->sum() == 0.0) return "";
  const MechanismMotion& motion = *e.gives_way;
  constexpr double kNamed = 0.1;  // of the motion: less is not named
  std::vector<std::pair<double, const char*>> shares{
      {motion.hinging, "hinging"}, {motion.sliding, "sliding"}, {motion.parting, "parting"}};
  std::ranges::stable_sort(shares, std::ranges::greater(), &std::pair<double, const char*>::first);
  std::vector<std::string> ways;
  for (const auto& [speed, name] : shares)
    if (const double share = speed / motion.sum(); share >= kNamed)
      ways.push_back(fmt::format("{} ({:.0f} %{})", name, 100.0 * share,
                                 ways.empty() ? " of the motion of its joints" : ""));
  return fmt::format("gives way by {}: {}{}", fmt::join(ways, " and "), counts_text(motion.joints),
                     moving_courses(e, motion) + missing_skewback(e, motion));
}

}  // namespace cupola
