#include "postproc/mechanics/stage_blocks.hpp"

#include <cmath>

#include "assembly/model/laying_course.hpp"

namespace cupola {
namespace {

/// The course of a stage, whose time is its ring, or a fraction less while the course is open.
int course_of(const Assembly& assembly, const Frame& stage) {
  return laying_course(assembly, static_cast<int>(std::ceil(stage.time)));
}

}  // namespace

std::vector<bool> laid_blocks(const Assembly& assembly, const Frame& stage) {
  const int course = course_of(assembly, stage);
  const bool open = stage.time < std::ceil(stage.time);
  std::vector<bool> laid;
  for (const Block& block : assembly.blocks)
    laid.push_back(laying_course(assembly, block) < course + (open ? 0 : 1));
  const auto lay = [&](const std::vector<int>& blocks) {
    for (const int block : blocks) laid[block] = true;
  };
  lay(stage.contacts.block_a), lay(stage.contacts.block_b);
  lay(stage.ties.block_a), lay(stage.ties.block_b);
  return laid;
}

std::vector<bool> blocks_left_out(const Assembly& assembly, const Frame& frame, int hold_below) {
  if (!is_stage(frame.role)) return {};
  const int course = course_of(assembly, frame);
  std::vector<bool> left_out = laid_blocks(assembly, frame);
  left_out.flip();
  for (size_t b = 0; b < left_out.size(); ++b)
    if (is_held(assembly, assembly.blocks[b], course, hold_below)) left_out[b] = true;
  return left_out;
}

bool takes_part(const Assembly& assembly, int block, const std::vector<bool>& left_out) {
  return !assembly.blocks[block].fixed && (left_out.empty() || !left_out[block]);
}

}  // namespace cupola
