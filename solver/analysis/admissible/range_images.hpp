#pragma once

#include "solver/analysis/admissible/range_end.hpp"
#include "solver/analysis/statics/model_symmetry.hpp"

namespace cupola {

/// Which of several objectives, the normal forces of joints, symmetries of the scene map on each other.
class RangeImages {
 public:
  RangeImages(const RigidScene& scene, const std::vector<RangeObjective>& objectives);

  /// The first objective that a symmetry maps on this one; itself if there is none before it.
  int original(int objective) const { return images_[objective].original; }
  bool has_images(int objective) const { return images_[objective].of_others; }
  /// The end of an objective from that of its original. None unless its own bounds prove it: coordinates may
  /// be symmetric up to rounding of a file only.
  std::optional<RangeSolution> end(int objective, double towards, const RangeSolution& of_original) const;

 private:
  struct Image {
    int original = 0;
    int symmetry = -1;       ///< maps the original on this; -1: it is its own original
    bool of_others = false;  ///< it is the original of others
  };

  const RigidScene& scene_;
  const std::vector<RangeObjective>& objectives_;
  std::vector<ModelSymmetry> symmetries_;
  std::vector<Image> images_;
};

}  // namespace cupola
