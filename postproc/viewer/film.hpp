#pragma once

#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// The frames of a run as the 3-D view shows them: where every block is, and the forces of the states that a
/// range analysis found. Filled frame by frame, because a run may have more frames than fit into memory.
class Film {
 public:
  /// `displacement`: one state, whose displacement can be magnified. `motion`: instants or steps.
  /// `mechanism`: directions of motion, from rest to the size at which they are drawn. `stages`: of
  /// construction, in the order of laying.
  enum class Kind { displacement, motion, mechanism, stages };

  /// Joints and forces of one frame.
  struct State {
    std::string name;
    JointWrenches joints;
  };

  /// The evaluation must outlive the film.
  explicit Film(const Evaluation& evaluation);

  /// Takes frame `index` of the run, in ascending order.
  void add(size_t index, const FrameEvaluation& frame);

  Kind kind() const { return kind_; }
  int num_frames() const { return static_cast<int>(labels_.size()); }
  int skipped() const { return skipped_; }                ///< frames left out to limit the size
  int skipped_states() const { return skipped_states_; }  ///< states of a range left out, likewise
  const std::vector<std::string>& labels() const { return labels_; }  ///< of the frames
  const std::vector<double>& shifts() const { return shifts_; }       ///< m, (num_frames x blocks x 3)
  const std::vector<double>& turns() const { return turns_; }         ///< rad, rotation vectors, likewise
  const std::vector<int>& bodies() const { return bodies_; }          ///< per block, body with which it moves
  /// Of stages: per block, frame in which it is first laid; beyond the last one if in none.
  const std::vector<int>& born() const { return born_; }
  const std::vector<State>& range_states() const { return states_; }
  /// The frame to which the forces of the evaluation belong; of a mechanism its start; -1: none.
  int evaluated() const { return evaluated_; }

 private:
  void add_poses(const Frame& frame);
  void add_births(const Frame& frame);
  void add_range_state(const FrameEvaluation& frame);

  const Evaluation& evaluation_;
  Kind kind_ = Kind::displacement;
  size_t stride_ = 1;
  int evaluated_ = -1;
  int skipped_ = 0, skipped_states_ = 0;
  std::vector<std::string> labels_;
  std::vector<double> shifts_, turns_;
  std::vector<int> bodies_, born_;
  std::vector<State> states_;
};

}  // namespace cupola
