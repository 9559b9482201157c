#include "solver/dynamics/laying_order.hpp"

#include <algorithm>
#include <map>

#include "assembly/model/laying_course.hpp"

namespace cupola {
namespace {

/// True if the slots of a course count clockwise about the axis of its sheet, as in a mirror image. Rows
/// without an axis have no such sense.
bool runs_clockwise(const Assembly& assembly, const std::vector<int>& course) {
  constexpr double kRounding = 1e-9;  // two halves of a ring run either way
  double area = 0.0, size = 0.0;      // m2, twice that between axis and course
  for (size_t i = 1; i < course.size(); ++i) {
    const Block &from = assembly.blocks[course[i - 1]], &to = assembly.blocks[course[i]];
    const Sheet* sheet = assembly.sheet_of(from.ring);
    using enum Sheet::ThrustLines;
    if (!sheet || sheet->thrust_lines == none || sheet->thrust_lines == one) return false;
    const Vec3 a = sheet->own(from.centroid), b = sheet->own(to.centroid);
    area += a.x() * b.y() - a.y() * b.x();
    size += a.head<2>().norm() * b.head<2>().norm();
  }
  return area < -kRounding * size;
}

/// The blocks of a course in the order in which one team would lay them all.
std::vector<int> course_in_order(const Assembly& assembly, const StagedConstruction& staged,
                                 const std::vector<int>& courses, int number) {
  using enum StagedConstruction::Order;
  std::vector<int> course;
  for (int block = 0; block < static_cast<int>(assembly.blocks.size()); ++block)
    if (!assembly.blocks[block].fixed && courses[block] == number) course.push_back(block);
  const auto slot = [&](int block) { return assembly.blocks[block].slot; };
  std::ranges::stable_sort(course, {}, slot);
  const bool backwards = staged.order == clockwise || (staged.order == alternating && number % 2 == 1);
  if (backwards != runs_clockwise(assembly, course)) std::ranges::reverse(course);
  if (staged.order != given) return course;
  std::map<int, size_t> place;
  for (size_t i = 0; i < staged.sequence.size(); ++i) place.try_emplace(staged.sequence[i], i);
  std::ranges::stable_sort(course, {}, [&](int block) {
    const auto found = place.find(block);
    return found == place.end() ? staged.sequence.size() : found->second;
  });
  return course;
}

}  // namespace

std::vector<int> laying_courses(const Assembly& assembly) {
  std::vector<int> courses;
  for (const Block& block : assembly.blocks) courses.push_back(laying_course(assembly, block));
  return courses;
}

std::vector<LaidBlocks> laying_order(const Assembly& assembly, const StagedConstruction& staged) {
  const std::vector<int> courses = laying_courses(assembly);
  std::vector<LaidBlocks> stages;
  int top = 0;
  for (const Block& block : assembly.blocks) top = std::max(top, block.ring);
  if (staged.last_ring >= 0) top = std::min(top, staged.last_ring);
  for (int ring = 0, number = -1; ring <= top; ++ring) {
    if (laying_course(assembly, ring) <= number) continue;  // laid with a lower ring
    number = laying_course(assembly, ring);
    const std::vector<int> course = course_in_order(assembly, staged, courses, number);
    if (ring < staged.first_ring || course.empty()) continue;
    if (staged.unit == StagedConstruction::Unit::ring) {
      stages.push_back({ring, number, 1.0, course});
      continue;
    }
    const size_t n = course.size(), teams = std::min<size_t>(staged.teams, n);
    const size_t longest = (n + teams - 1) / teams;
    for (size_t k = 0; k < longest; ++k) {
      LaidBlocks stage{ring, number, static_cast<double>(k + 1) / static_cast<double>(longest), {}};
      for (size_t team = 0; team < teams; ++team) {
        const size_t start = team * n / teams, end = (team + 1) * n / teams;
        if (start + k < end) stage.blocks.push_back(course[start + k]);
      }
      stages.push_back(std::move(stage));
    }
  }
  return stages;
}

}  // namespace cupola
