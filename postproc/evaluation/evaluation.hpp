#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/files/results_file.hpp"
#include "postproc/mechanics/block_fields.hpp"
#include "postproc/mechanics/cuts.hpp"
#include "postproc/mechanics/plane_cut.hpp"
#include "postproc/mechanics/ring_sums.hpp"
#include "postproc/mechanics/thrust_line.hpp"

namespace cupola {

/// What one frame says, derived from its contacts.
struct FrameEvaluation {
  Frame frame;
  Vec3 gravity = Vec3::Zero();    ///< m/s2, at that instant
  std::vector<PointForce> loads;  ///< at that instant
  JointWrenches joints;
  std::vector<Wrench> from_below;   ///< per block
  std::vector<BlockFields> fields;  ///< per block
  std::vector<int> groups;          ///< per block, bodies of the mechanism
};

/// A meridian with what crosses it.
struct MeridianEvaluation {
  ThrustLine thrust;
  std::vector<HoopRow> hoop;  ///< empty for an arch
};

/// What crosses a bed within one block's width, on the part above.
struct BedResultant {
  int block = 0;
  Wrench wrench;               ///< about the block's centroid
  Vec3 point = Vec3::Zero();   ///< m, of its central axis at the bed's mean height
  double couple_length = 0.0;  ///< m
};

/// A horizontal section: the blocks that the plane cuts, and the bed below the nearest ring.
struct SectionEvaluation {
  double height = 0.0;  ///< m
  int ring = -1;        ///< ring whose bed lies nearest; -1 where there are no rings
  std::vector<CutPolygon> polygons;
  std::vector<BedResultant> resultants;  ///< of that bed, by block; none where nothing presses
};

/// Everything the postprocessor knows about a run: the last frame in full.
struct Evaluation {
  Case scene;
  Assembly assembly;
  Summary summary;
  std::vector<double> times;  ///< s, of all frames
  Vec3 up = Vec3::UnitZ();
  std::vector<PointForce> loads;  ///< at their full values
  Shell shell;
  std::vector<ShellAxes> axes;
  FrameEvaluation last;
  std::vector<RingSum> rings;
  std::vector<MeridianEvaluation> meridians;
  std::vector<SectionEvaluation> sections;
  std::vector<PlaneCut> planes;
  std::optional<double> rib_over_mid_sail;  ///< mean ratio of r on the meridians `rib` and `mid_sail`
  std::optional<int> lost_joints;           ///< loaded in the first frame, gone in the last; none: not known
  std::vector<std::string> warnings;        ///< what a reader must know before the numbers
  std::vector<std::string> unreadable;      ///< what is missing from the results or damaged, once each
};

/// Notes that a part of the results is left out, if that is not noted yet.
void leave_out(const std::string& part, const std::string& reason, Evaluation* evaluation);

/// What comes before all numbers: first what could not be read, then the warnings.
std::vector<std::string> said_first(const Evaluation& evaluation);

/// Evaluates the last readable frame. Frames that are missing or damaged are left out, unless none is left:
/// then InputError.
Evaluation evaluate(const Case& scene, Assembly assembly, const ResultsReader& results);

/// Evaluates one frame against an evaluation's assembly, loads and shell. The second frame of a limit
/// analysis, its mechanism, is shown displaced along its velocities.
FrameEvaluation evaluate_frame(const Evaluation& evaluation, Frame frame);

/// Mean over common beds of r of one line over r of the other; none without common beds.
std::optional<double> mean_ratio(const ThrustLine& numerator, const ThrustLine& denominator);

}  // namespace cupola
