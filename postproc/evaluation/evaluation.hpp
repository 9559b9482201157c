#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/files/results_file.hpp"
#include "postproc/evaluation/rib_ratio.hpp"
#include "postproc/mechanics/block_fields.hpp"
#include "postproc/mechanics/chain_forces.hpp"
#include "postproc/mechanics/cracks.hpp"
#include "postproc/mechanics/cuts.hpp"
#include "postproc/mechanics/joint_speeds.hpp"
#include "postproc/mechanics/member_sums.hpp"
#include "postproc/mechanics/plane_cut.hpp"
#include "postproc/mechanics/poses.hpp"
#include "postproc/mechanics/reactions.hpp"
#include "postproc/mechanics/ring_sums.hpp"
#include "postproc/mechanics/shell_cracks.hpp"
#include "postproc/mechanics/thrust_line.hpp"
#include "postproc/mechanics/wythe_sums.hpp"

namespace cupola {

/// One frame and all quantities derived from its contacts.
struct FrameEvaluation {
  Frame frame;
  Vec3 gravity = Vec3::Zero();    ///< m/s2, at the time of the frame
  std::vector<PointForce> loads;  ///< at the time of the frame
  Poses poses;                    ///< at which its forces balance
  JointWrenches joints;
  std::vector<Wrench> from_below;   ///< per block, wrench from the ring below
  std::vector<BlockFields> fields;  ///< per block
  std::vector<int> groups;          ///< per block, group that moves as one body
};

/// A meridian: the thrust lines along it and the hoop forces across it.
struct MeridianEvaluation {
  ThrustLine thrust;
  std::vector<ThrustLine>
      wythes;                 ///< of each wythe that has points on it, inside first; empty without wythes
  std::vector<HoopRow> hoop;  ///< empty for an arch
  /// Thrust lines at the ends of the range of the thrust, if the run has their frames.
  std::optional<ThrustLine> least_thrust, greatest_thrust;
};

/// The resultant across a bed within the width of one block, on the part above or nearer to the crown.
struct BedResultant {
  int block = 0;
  BlockKind kind = BlockKind::standard;
  Wrench wrench;               ///< about the block's centroid
  Vec3 point = Vec3::Zero();   ///< m, on its central axis, at the mean height of the bed
  double azimuth = 0.0;        ///< rad, of the point about the axis of the block
  double couple_length = 0.0;  ///< m; NaN if the wrench is negligible
};

/// A horizontal section: the blocks that the plane cuts, and the forces across the nearest bed of each stack
/// that stands there, of an arch of both haunches.
struct SectionEvaluation {
  double height = 0.0;    ///< m
  std::vector<int> beds;  ///< empty without rings
  std::vector<CutPolygon> polygons;
  std::vector<BedResultant> resultants;  ///< across these beds, by block; empty if they carry no force
};

/// Everything the postprocessor derives from a run, for its first frame if that is an equilibrium, else for
/// its last readable one. Without an equilibrium (at_rest()) the forces are those of one instant or of an
/// unfinished solve: tables hold them, texts and figures do not interpret them.
struct Evaluation {
  Case scene;
  Assembly assembly;  ///< with the thickness of the stable end, if a limit analysis varies it
  Summary summary;
  std::vector<double> times;  ///< s, of all frames; their numbers where the times do not increase
  /// Against gravity, as pictures show it; vertical parts of forces are along z.
  Vec3 up = Vec3::UnitZ();
  Loads acting;                   ///< of the case, at the stable end of a limit analysis
  std::vector<PointForce> loads;  ///< of `acting`, at their full values
  Shell shell;
  std::vector<ShellAxes> axes;
  FrameEvaluation last;
  int last_frame = -1;  ///< its number
  std::vector<RingSum> rings;
  std::vector<MemberSum> members;  ///< empty without wythes
  std::vector<WytheSum> wythes;    ///< empty without wythes
  std::vector<ChainForces> chains;
  std::vector<Reaction> reactions;           ///< of the last frame, on the supports
  std::vector<Crack> joint_cracks;           ///< of `last`
  std::vector<ShellCrack> cracks;            ///< of an equilibrium, the widest first
  std::vector<int> parts;                    ///< connected_parts()
  std::optional<MechanismMotion> gives_way;  ///< of a run with a mechanism
  std::vector<MeridianEvaluation> meridians;
  std::vector<SectionEvaluation> sections;
  std::vector<PlaneCut> planes;
  std::optional<RibRatio> rib_over_mid_sail;  ///< of a whole vault with sails, of one member and bond
  std::optional<int> lost_joints;             ///< loaded in the first frame, gone in the last; none: unknown
  std::vector<std::string> warnings;          ///< of the results, then the doubts about case and blocks
  std::vector<std::string> unreadable;        ///< parts of the results that are missing or damaged
};

/// True if the forces evaluated are those of an equilibrium. Those of a motion or of stages are if the run is
/// stable.
bool at_rest(const Evaluation& evaluation);

bool is_limit(const Evaluation& evaluation);

/// True if the joints evaluated are those of a critical joint_extent, of other extent than as built.
bool has_scaled_joints(const Evaluation& evaluation);

/// ", of 0.8 times their extent": what headings of joints add then; "" otherwise.
std::string of_extent(const Evaluation& evaluation);

/// True if supports move in time, and the forces are those at the time 0, before they do.
bool supports_have_not_moved(const Evaluation& evaluation);

/// True if joints are taken as rigid, in limits and ranges, so that their gaps are not the widths of cracks.
bool is_rigid(const Evaluation& evaluation);
/// The stiffness of the joints is that of a case which gives none.
bool has_default_stiffness(const Evaluation& evaluation);

/// True for a vault about the z axis, where azimuths are meaningful.
bool is_vault(const Evaluation& evaluation);

/// True for an arch or barrel vault over x, whose courses run along y.
bool is_arch(const Evaluation& evaluation);

/// Records that a part of the results was left out and why, once per part.
void leave_out(const std::string& part, const std::string& reason, Evaluation* evaluation);

/// Everything to report before the numbers: first the parts that could not be read, then the warnings.
std::vector<std::string> notices(const Evaluation& evaluation);

/// Evaluates the frame that Evaluation describes. Missing or damaged frames are left out and recorded;
/// InputError if none can be read. `doubts`: warnings about the case and the blocks.
Evaluation evaluate(const Case& scene, Assembly assembly, const ResultsReader& results,
                    const std::vector<std::string>& doubts = {});

/// Sets gravity and loads of a frame to those at `time`, s.
void set_loads(const Evaluation& evaluation, double time, FrameEvaluation* shown);

/// Evaluates one frame with the assembly, loads and shell of an evaluation, without the motion of the ground.
/// The blocks of a mechanism are displaced along their velocities, far enough to be seen.
FrameEvaluation evaluate_frame(const Evaluation& evaluation, Frame frame);

}  // namespace cupola
