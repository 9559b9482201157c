#include "assembly/files/old_frames.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace cupola {
namespace {

FrameRole role_of_solve(Status status) {
  if (stands(status)) return FrameRole::equilibrium;
  return status == Status::unconverged ? FrameRole::unconverged : FrameRole::mechanism;
}

bool moves(const Frame& frame) {
  return std::any_of(frame.blocks.velocity.begin(), frame.blocks.velocity.end(),
                     [](const Vec3& v) { return v != Vec3::Zero(); });
}

/// The first frame of a range analysis is a state; the others are ends of the ranges, which name them.
void set_role_in_ranges(const Summary& summary, int index, Frame* frame) {
  if (index == 0)
    return set_role(summary.ranges.empty() ? role_of_solve(summary.status) : FrameRole::equilibrium, "",
                    frame);
  set_role(FrameRole::range_end, "", frame);
  for (const ForceRange& range : summary.ranges)
    for (const auto& [end, name] : {std::pair{&range.min, "least"}, std::pair{&range.max, "greatest"}})
      if (end->frame == index)
        set_role(end->outcome == RangeOutcome::unbounded ? FrameRole::self_stress : FrameRole::range_end,
                 fmt::format("{} {}", name, range.quantity), frame);
}

}  // namespace

void set_role_of_old_frame(const Summary& summary, int index, Frame* frame) {
  switch (summary.analysis) {
    case AnalysisType::static_:
      return set_role(role_of_solve(summary.status), "", frame);
    case AnalysisType::dynamic:  // a run whose static start failed has no speed
      return set_role(summary.max_speed_m_per_s ? FrameRole::step : role_of_solve(summary.status), "", frame);
    case AnalysisType::staged:
      return set_role(moves(*frame) ? FrameRole::failed_stage : FrameRole::stage,
                      fmt::format("stage {}", index), frame);
    case AnalysisType::limit:
      return set_role(frame->time > 0.0 ? FrameRole::mechanism : FrameRole::equilibrium,
                      summary.critical ? summary.critical->parameter : "", frame);
    case AnalysisType::path:
      return set_role(summary.steps > 0 ? FrameRole::path : role_of_solve(summary.status), "", frame);
    case AnalysisType::range:
      return set_role_in_ranges(summary, index, frame);
  }
}

void set_contact_poses_of_old_frame(Frame* frame) {
  const bool moves = frame->role == FrameRole::step || frame->role == FrameRole::path;
  if (!moves || !frame->blocks.contact_position.empty()) return;
  frame->blocks.contact_position = frame->blocks.position;
  frame->blocks.contact_quaternion_wxyz = frame->blocks.quaternion_wxyz;
}

}  // namespace cupola
