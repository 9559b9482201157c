#pragma once

#include <string>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// post/summary.json (FORMAT.md lists its keys): the run's provenance and status, ring sums, uniformity,
/// thrust lines and the largest of what matters.
std::string post_summary_json(const Evaluation& evaluation);

/// The numbers that compare two runs, from summary.json or straight from an evaluation.
struct PostSummary {
  std::string title, status, friction_law, program_version, folder;
  int blocks = 0;
  double weight_N = 0.0;
  double block_size_m = 0.0;  ///< cube root of the free blocks' mean volume
  double friction = 0.0;
  double largest_ring_difference = 0.0;  ///< over the rings, relative
  double mean_cv_pressure = 0.0;         ///< mean over the rings
  double largest_cv_pressure = 0.0;
  std::optional<double> rib_over_mid_sail;
  double largest_couple_length_m = 0.0;
  double largest_friction_use = 0.0;
  double mean_kern_use = 0.0;  ///< of the bed joints, weighted by their force
  double thrust_over_weight = 0.0;
  double max_displacement_m = 0.0;
  double equilibrium_residual = 0.0;
  std::optional<double> critical_value;  ///< of a limit analysis
  struct Line {
    std::string name;
    int undefined = 0;  ///< beds without a place in the thickness
    bool inside = false;
    double least_face_distance_m = 0.0;
    double least_geometric_safety = 0.0;
  };
  std::vector<Line> thrust_lines;
};
PostSummary post_summary(const Evaluation& evaluation);
PostSummary read_post_summary(const std::string& folder);

}  // namespace cupola
