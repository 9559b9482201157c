#pragma once

#include <array>
#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/tables/column.hpp"

namespace cupola {

// The columns of all results, one list per subject. To add a column, add one line to a list in
// result_columns.cpp; to put it into a mesh file too, add its key to the file's list below.

/// A block of one frame.
struct BlockRow {
  const Block& block;
  const BlockFields& fields;
  const Wrench& from_below;
  CentralAxis axis;       ///< of `from_below`
  Vec3 displacement;      ///< m
  double weight = 0.0;    ///< N
  int index = 0;          ///< into Assembly::blocks
  int ring = 0;           ///< first ring of the block; ring of the part in meshes of parts
  int beside_spiral = 0;  ///< 1: laid flat, with a head joint to a herringbone block
  int mechanism_group = 0;
  bool laid = true;  ///< false: a stage of a construction does not have it
};
std::vector<BlockRow> block_rows(const Evaluation& evaluation, const FrameEvaluation& frame);

/// A joint across a plane cut.
struct PlaneJoint {
  const JointWrench& joint;
  Vec3 force;            ///< N, on the block beyond the plane
  double through = 0.0;  ///< N, along the plane's normal
  double along = 0.0;    ///< N, in the plane
};
std::vector<PlaneJoint> plane_joints(const Evaluation& evaluation, const PlaneCut& cut);

/// What a member of a shell with wythes carries through a cut.
struct MemberRow {
  const MemberSum& sum;
  std::string name;
  double height = 0.0;  ///< m, of the cut, see RingSum
};
std::vector<MemberRow> member_rows(const Evaluation& evaluation);

/// What passes through a wythe of a cut.
struct WytheRow {
  const WytheSum& sum;
  std::string name;     ///< of the wythe, or "A to B" of the first and the last of several
  double height = 0.0;  ///< m, of the cut, see RingSum
};
std::vector<WytheRow> wythe_rows(const Evaluation& evaluation);

/// A tie of one frame.
struct TieRow {
  const TieTable& ties;
  int index = 0;
  std::string chain;  ///< its name, or "" for none
};
std::vector<TieRow> tie_rows(const Evaluation& evaluation);

/// A crack, with its number.
struct CrackRow {
  const ShellCrack& crack;
  int number = 0;
};
std::vector<CrackRow> crack_rows(const Evaluation& evaluation);

/// A cell of thrust_lines.vtp.
struct LineCell {
  enum What { line_of_thrust, envelope, line_of_action, intrados, extrados, line_of_wythe };
  int what = line_of_thrust;
  int meridian = 0;        ///< index into Evaluation::meridians
  double resultant = 0.0;  ///< N, of a line of action
};

/// A cell of sections.vtp.
struct SectionCell {
  enum What { segment, outline };
  int what = segment;
  int cut = 0;  ///< sections first, then planes
  int block = 0;
  double height = 0.0;     ///< m, of the section or of the plane's point
  double resultant = 0.0;  ///< N, of a segment
};

const Columns<ForceRange>& range_columns();
const Columns<RingSum>& ring_columns();
const Columns<JointWrench>& joint_columns();
const Columns<BlockRow>& block_columns();
const Columns<MemberRow>& member_columns();
const Columns<WytheRow>& wythe_columns();
const Columns<ThrustPoint>& thrust_columns();
const Columns<HoopRow>& hoop_columns();
const Columns<ChainForces>& chain_columns();
const Columns<TieRow>& tie_columns();
const Columns<Reaction>& reaction_columns();
const Columns<CrackRow>& crack_columns();
const Columns<BedResultant>& section_columns();
const Columns<PlaneJoint>& plane_columns();
const Columns<LineCell>& line_cell_columns();
const Columns<SectionCell>& section_cell_columns();

/// blocks_NNNN.vtu: cell data, one value per part.
inline constexpr std::array kBlockMeshKeys{"meridional_force_N_per_m",
                                           "hoop_force_N_per_m",
                                           "resultant_N",
                                           "couple_length_m",
                                           "friction_use",
                                           "kern_use",
                                           "opening_m",
                                           "slip_m",
                                           "mechanism_group",
                                           "block",
                                           "ring",
                                           "kind",
                                           "member"};
/// wrenches.vtp: cell data and point data.
inline constexpr std::array kWrenchCellKeys{"block", "ring", "kind", "resultant_N", "couple_length_m"};
inline constexpr std::array kWrenchPointKeys{"force_N", "couple_Nm"};
/// joints.vtp: point data; joint_forces.vtp: cell data.
inline constexpr std::array kJointKeys{
    "force_magnitude_N", "force_N",   "moment_Nm", "normal",  "couple_length_m", "eccentricity_m", "kern_use",
    "friction_use",      "opening_m", "slip_m",    "block_a", "block_b",         "kind",           "ring"};
/// ties.vtp: cell data.
inline constexpr std::array kTieKeys{"force_N", "yield_force_N", "yielded_m", "block_a", "block_b"};
/// cracks.vtp: cell data.
inline constexpr std::array kCrackKeys{"opening_m", "slip_m", "kind"};
inline constexpr std::array kCrackNumberKeys{"crack"};
/// thrust_lines.vtp and sections.vtp: cell data.
inline constexpr std::array kLineCellKeys{"what", "meridian", "resultant_N"};
inline constexpr std::array kSectionCellKeys{"what", "cut", "block", "height_m", "resultant_N"};
/// summary.json: `ranges`.
inline constexpr std::array kRangeSummaryKeys{"quantity",    "unit",      "min",       "chosen",
                                              "max",         "min_bound", "max_bound", "min_outcome",
                                              "max_outcome", "min_frame", "max_frame", "relative_range",
                                              "block_a",     "block_b"};
/// summary.json: `rings`.
inline constexpr std::array kRingSummaryKeys{
    "ring",         "height_m",   "joint_force_N", "load_above_N", "relative_difference",
    "cv_resultant", "cv_pressure"};

/// summary.json: `chains`.
inline constexpr std::array kChainSummaryKeys{
    "chain", "height_m", "mean_force_N", "least_force_N", "greatest_force_N", "yield_force_N", "yielded_m"};

/// A table that shows one of the results again.
struct CopiedTable {
  std::string heading;
  std::vector<Table::Column> columns;
};

/// Every list above as Markdown: name, unit and meaning of each column, and the mesh files that hold it; then
/// the columns of further tables.
std::string column_reference(const std::vector<CopiedTable>& further);

}  // namespace cupola
