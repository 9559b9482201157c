#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "solver/analysis/admissible/range_end.hpp"
#include "solver/analysis/analysis.hpp"
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

/// Both ends of every objective, first all greatest values; frames are written in the order in which they are
/// found.
class RangeRun {
 public:
  RangeRun(const RigidScene& scene, const std::vector<RangeObjective>& objectives, const Case& of_case,
           const AnalysisSinks& sinks);

  /// Solves the ends, as many at once as there are threads. False if the user wants to stop.
  [[nodiscard]] bool run(std::vector<ForceRange>* ranges);
  int solves() const { return solves_; }
  int iterations() const { return iterations_; }
  int images() const { return images_found_; }  ///< ends that follow from others by symmetry
  int of_sector() const { return of_sector_; }  ///< ranges for which one sector was solved

 private:
  bool run(double towards, std::vector<int> ends, std::vector<ForceRange>* ranges);
  RangeSolution solve(int objective, double towards) const;
  void record(int objective, double towards, RangeSolution* found, ForceRange* range);
  std::vector<int> least_to_solve(std::vector<ForceRange>* ranges) const;
  void find_vanishing(const RangeSolution& state);
  void write_frame(const std::string& end, RangeSolution* solution);

  const RigidScene& scene_;
  const std::vector<RangeObjective>& objectives_;
  const bool states_;
  const AnalysisSinks& sinks_;
  std::optional<SectorProblem> sector_;
  RangeImages images_;
  std::map<int, RangeSolution> originals_;  ///< bounded ends of one direction, by objective
  std::vector<SparseX> never_less_;         ///< coefficients_in_dual_cone() of the objectives
  std::vector<char> vanishes_;              ///< in a state of another end
  int frames_ = 1;                          // frame 0 is written before
  int solves_ = 0, iterations_ = 0, images_found_ = 0, of_sector_ = 0;
};

}  // namespace cupola
