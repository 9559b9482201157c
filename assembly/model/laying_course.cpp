#include "assembly/model/laying_course.hpp"

#include <algorithm>

namespace cupola {

int laying_course(const Assembly& assembly, int ring) {
  int course = ring;
  for (const Sheet& sheet : assembly.sheets) {
    if (sheet.thrust_lines != Sheet::ThrustLines::one || ring < sheet.first_ring) continue;
    const int last = sheet.num_rings - 1, from_start = ring - sheet.first_ring;
    course -= from_start <= last ? std::max(0, 2 * from_start - last) : sheet.num_rings / 2;
  }
  return course;
}

int laying_course(const Assembly& assembly, const Block& block) {
  if (block.fixed) return -1;
  return std::min(laying_course(assembly, block.ring),
                  laying_course(assembly, block.ring + block.num_rings - 1));
}

int last_course(const Assembly& assembly) {
  int last = 0;
  for (const Block& block : assembly.blocks) last = std::max(last, laying_course(assembly, block));
  return last;
}

bool completes(const Assembly& assembly, int last_ring) {
  return last_ring < 0 || laying_course(assembly, last_ring) >= last_course(assembly);
}

bool is_held(const Assembly& assembly, const Block& block, int course, int hold_below) {
  if (block.fixed || hold_below < 0) return false;
  const int own = laying_course(assembly, block);
  const int end = laying_course(assembly, assembly.stack_of(block.ring).second);
  if (course < end) return own < course - hold_below;
  // The stack that is being laid may stand on several beside each other: count each from its top.
  int base = 0;
  for (const Sheet& sheet : assembly.sheets) {
    const int first = laying_course(assembly, sheet.first_ring);
    if (!sheet.on_previous && first <= course) base = std::max(base, first);
  }
  return (end - own) + (course - base) > hold_below;
}

}  // namespace cupola
