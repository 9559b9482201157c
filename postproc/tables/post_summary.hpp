#pragma once

#include <string>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// Text of post/summary.json: provenance and status of the run, ring sums, uniformity, thrust lines and
/// largest values. assembly/FORMAT.md lists its keys.
std::string post_summary_json(const Evaluation& evaluation);

/// The numbers by which runs are compared.
struct PostSummary {
  std::string title, status, friction_law, program_version, folder;
  int blocks = 0;
  double weight_N = 0.0;
  double block_size_m = 0.0;  ///< cube root of the free blocks' mean volume
  double friction = 0.0;
  double negligible_force_N = 0.0;  ///< floor of the frame: what is smaller counts as 0
  // The numbers down to `thrust_over_weight` interpret an equilibrium. A run that found none has none of
  // them.
  std::optional<double> largest_ring_difference;  ///< relative, largest over the rings
  std::optional<double> mean_cv_pressure;         ///< mean over the rings
  std::optional<double> largest_cv_pressure;
  std::optional<double> rib_over_mid_sail;  ///< RibRatio: mean, smallest and largest
  std::optional<double> rib_over_mid_sail_smallest, rib_over_mid_sail_largest;
  std::string
      compliance_per;  ///< "point" or "area": what joints.compliance refers to; "none" if joints are rigid
  std::optional<double> points_per_base_joint;    ///< mean number of contact points; none without base joints
  std::optional<double> largest_couple_length_m;  ///< of a block's wrench from the ring below
  std::optional<double> largest_friction_use;     ///< of a joint
  std::optional<double> largest_pressure_Pa;      ///< on a joint
  std::optional<double> largest_strength_use;     ///< of a joint with strength
  std::optional<double> crack_length_m;           ///< along the shell, of all cracks of cracks.csv
  std::optional<double> widest_crack_m;           ///< of the widest of them
  std::optional<double> mean_kern_use;            ///< mean over the bed joints, weighted by normal force
  std::optional<double> thrust_over_weight;
  std::optional<double> max_displacement_m;
  double equilibrium_residual = 0.0;     ///< infinite if the run has none
  std::optional<double> critical_value;  ///< of a limit analysis
  std::string critical_parameter;
  std::string critical_unit;            ///< limit_unit() of its parameter
  std::optional<double> margin_factor;  ///< of a limit analysis, factor_of_safety()
  struct Line {
    std::string name;
    int undefined = 0;  ///< beds on which its position is undefined
    bool inside = false;
    double least_face_distance_m = 0.0;
    double least_geometric_safety = 0.0;
  };
  std::vector<Line> thrust_lines;
  std::vector<ForceRange> ranges;  ///< of a range analysis
};
PostSummary post_summary(const Evaluation& evaluation);

/// Reads `folder`/summary.json; InputError if it is missing, damaged or of another version.
PostSummary read_post_summary(const std::string& folder);

}  // namespace cupola
