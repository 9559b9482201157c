#include "postproc/viewer/film.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "postproc/mechanics/stage_blocks.hpp"

namespace cupola {
namespace {

/// Largest number of poses (blocks times frames) of a film. A pose takes some 12 characters of the report, so
/// that the film takes 12 MB at most.
constexpr size_t kMostPoses = 1'000'000;

/// Largest number of joints of all states of a range together. A joint takes some 150 characters.
constexpr size_t kMostStateJoints = 50'000;

Vec3 rotation_vector(const Eigen::Vector4d& wxyz) {
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized());
  return turn.angle() * turn.axis();
}

void append_vector(const Vec3& v, std::vector<double>* numbers) {
  numbers->insert(numbers->end(), v.begin(), v.end());
}

Film::Kind kind_of(FrameRole shown) {
  if (is_stage(shown)) return Film::Kind::stages;
  if (shown == FrameRole::step || shown == FrameRole::path) return Film::Kind::motion;
  return shown == FrameRole::mechanism ? Film::Kind::mechanism : Film::Kind::displacement;
}

}  // namespace

Film::Film(const Evaluation& evaluation)
    : evaluation_(evaluation), kind_(kind_of(evaluation.last.frame.role)) {
  const size_t poses = evaluation.times.size() * evaluation.assembly.blocks.size();
  stride_ = std::max<size_t>(1, (poses + kMostPoses - 1) / kMostPoses);
}

void Film::add(size_t index, const FrameEvaluation& frame) {
  const bool is_evaluated = static_cast<int>(index) == evaluation_.last_frame;
  if (kind_ == Kind::motion || kind_ == Kind::stages) {
    if (index % stride_ != 0 && !is_evaluated) {
      ++skipped_;
      return;
    }
    if (is_evaluated) bodies_ = frame.groups, evaluated_ = num_frames();
    if (kind_ == Kind::stages) add_births(frame.frame);
    add_poses(frame.frame);
  } else if (frame.frame.role == FrameRole::mechanism) {  // replaces the equilibrium that it follows
    kind_ = Kind::mechanism;
    evaluated_ = 0;
    labels_.clear(), shifts_.clear(), turns_.clear();
    bodies_ = frame.groups;
    add_poses(frame.frame);
  } else if (is_evaluated) {
    bodies_ = frame.groups;
    evaluated_ = 0;
    add_poses(frame.frame);
  } else {
    add_range_state(frame);
  }
}

void Film::add_births(const Frame& frame) {
  const std::vector<bool> laid = laid_blocks(evaluation_.assembly, frame);
  born_.resize(laid.size(), std::numeric_limits<int>::max());
  for (size_t block = 0; block < laid.size(); ++block)
    if (laid[block]) born_[block] = std::min(born_[block], num_frames());
}

void Film::add_poses(const Frame& frame) {
  labels_.push_back(frame.label);
  const BlockTable& blocks = frame.blocks;
  const std::vector<Block>& rest = evaluation_.assembly.blocks;
  for (size_t b = 0; b < rest.size(); ++b) {
    append_vector(blocks.position[b] - rest[b].centroid, &shifts_);
    append_vector(rotation_vector(blocks.quaternion_wxyz[b]), &turns_);
  }
}

void Film::add_range_state(const FrameEvaluation& frame) {
  size_t joints = evaluation_.last.joints.wrenches.size() + frame.joints.wrenches.size();
  for (const State& state : states_) joints += state.joints.wrenches.size();
  if (joints > kMostStateJoints)
    ++skipped_states_;
  else
    states_.push_back({frame.frame.label, frame.joints});
}

}  // namespace cupola
