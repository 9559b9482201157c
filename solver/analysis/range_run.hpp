#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "solver/analysis/admissible/range_images.hpp"
#include "solver/analysis/analysis.hpp"

namespace cupola {

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
