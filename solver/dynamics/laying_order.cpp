#include "solver/dynamics/laying_order.hpp"

#include <algorithm>
#include <map>

#include "assembly/model/laying_course.hpp"

namespace cupola {
namespace {

/// The blocks of a course in the order in which one team would lay them all.
std::vector<int> course_in_order(const Assembly& assembly, const StagedConstruction& staged,
                                 const std::vector<int>& courses, int number) {
  using enum StagedConstruction::Order;
  std::vector<int> course;
  for (int block = 0; block < static_cast<int>(assembly.blocks.size()); ++block)
    if (!assembly.blocks[block].fixed && courses[block] == number) course.push_back(block);
  const auto slot = [&](int block) { return assembly.blocks[block].slot; };
  std::ranges::stable_sort(course, {}, slot);
  if (staged.order == clockwise || (staged.order == alternating && number % 2 == 1))
    std::ranges::reverse(course);
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
