#include "postproc/report/gives_way.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/mechanics/mechanism_motion.hpp"

namespace cupola {
namespace {

/// "course 7 of barrel (z = 4.5 m)". `course`: of the assembly.
std::string course_text(const Evaluation& e, int course) {
  const Sheet* sheet = e.assembly.sheet_of(course);
  const std::string of = sheet && e.assembly.sheets.size() > 1 ? " of " + sheet->name : "";
  return fmt::format("course {}{} (z = {:.3g} m)", course, of, e.rings[course].height);
}

/// "; 60 % of the motion is at course 7 (z = 4.5 m)": the courses that move most, until they make up half of
/// the motion, at most three; "" without courses.
std::string moving_courses(const Evaluation& e, const MechanismMotion& motion) {
  constexpr double kEnough = 0.5;
  constexpr size_t kMost = 3;
  std::vector<std::pair<double, int>> courses;
  for (const auto& [course, speed] : motion.by_course)
    if (course >= 0 && course < static_cast<int>(e.rings.size())) courses.emplace_back(speed, course);
  std::ranges::stable_sort(courses, std::ranges::greater(), &std::pair<double, int>::first);
  std::vector<std::string> names;
  double sum = 0.0;
  for (const auto& [speed, course] : courses) {
    if (names.size() == kMost || sum >= kEnough * motion.sum()) break;
    sum += speed;
    names.push_back(course_text(e, course));
  }
  return names.empty() ? ""
                       : fmt::format("; {:.0f} % of the motion is at {}", 100.0 * sum / motion.sum(),
                                     fmt::join(names, ", "));
}

/// "hinges form at 4 joints, 12 joints slide".
std::string counts_text(const GivesWay& joints) {
  std::vector<std::string> parts;
  const auto add = [&parts](int count, const char* one, const char* many) {
    if (count > 0) parts.push_back(fmt::format("{} {}", counted(count, "joint"), count == 1 ? one : many));
  };
  if (joints.hinging > 0) parts.push_back("hinges form at " + counted(joints.hinging, "joint"));
  add(joints.sliding, "slides", "slide");
  add(joints.opening, "opens", "open");
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::string joints_that_give_way(const Evaluation& e) {
  return e.gives_way ? counts_text(*e.gives_way) : "";
}

std::string how_it_gives_way(const Evaluation& e) {
  if (e.last.frame.role != FrameRole::mechanism) return "";
  constexpr double kNamed = 0.1;  // of the motion: less is not named
  const double dilatancy =
      e.summary.friction_law == FrictionLaw::coulomb ? 0.0 : e.summary.dilatancy.value_or(1.0);
  const MechanismMotion motion =
      mechanism_motion(e.assembly, e.last.frame, e.last.joints, dilatancy * e.scene.joints.friction);
  if (motion.sum() == 0.0) return "";
  std::vector<std::pair<double, const char*>> shares{
      {motion.hinging, "hinging"}, {motion.sliding, "sliding"}, {motion.parting, "parting"}};
  std::ranges::stable_sort(shares, std::ranges::greater(), &std::pair<double, const char*>::first);
  std::vector<std::string> ways;
  for (const auto& [speed, name] : shares)
    if (const double share = speed / motion.sum(); share >= kNamed)
      ways.push_back(fmt::format("{} ({:.0f} %{})", name, 100.0 * share,
                                 ways.empty() ? " of the motion of its joints" : ""));
  return fmt::format("It gives way by {}: {}{}.", fmt::join(ways, " and "), counts_text(motion.joints),
                     moving_courses(e, motion));
}

}  // namespace cupola
