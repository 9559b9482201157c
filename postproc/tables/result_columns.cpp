#include "postproc/tables/result_columns.hpp"

#include <limits>

#include <fmt/format.h>

#include "postproc/tables/range_values.hpp"

namespace cupola {
namespace {

/// Kinds as tables and mesh files give them: "bed (0), head (1), ...".
template <NamedEnum E>
std::string names_and_codes() {
  std::string text;
  int code = 0;
  for (const std::string& name : names_of<E>())
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", name, code++);
  return text;
}

double or_nan(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

// clang-format off: one line per column.

const Columns<ForceRange>& range_columns() {
  using R = ForceRange;
  static const Columns<R> columns{
      {"quantity", "", "of the forces", &R::quantity},
      {"unit", "", "of the values of the row: N, m or none", &R::unit},
      {"min", "", "smallest value of the states found; -inf: unbounded", [](const R& r) { return least(r); }},
      {"chosen", "", "value in the state that the compliances choose; empty without one",
       [](const R& r) { return or_nan(r.chosen); }},
      {"max", "", "largest value of the states found; inf: unbounded",
       [](const R& r) { return greatest(r); }},
      {"min_bound", "",
       "no admissible state lies below, with forces of up to 1000 times those of the state found",
       [](const R& r) { return or_nan(r.min.bound); }},
      {"max_bound", "", "no admissible state lies above, likewise",
       [](const R& r) { return or_nan(r.max.bound); }},
      {"min_outcome", "", "bounded, unbounded, undefined or unconverged",
       [](const R& r) { return to_string(r.min.outcome); }},
      {"max_outcome", "", "bounded, unbounded, undefined or unconverged",
       [](const R& r) { return to_string(r.max.outcome); }},
      {"min_frame", "", "frame of the state of the smallest value; -1: none",
       [](const R& r) { return r.min.frame.value_or(-1); }},
      {"max_frame", "", "frame of the state of the largest value; -1: none",
       [](const R& r) { return r.max.frame.value_or(-1); }},
      {"relative_range", "", "width of the range over its mean, 0: certain, 2: from zero; inf: unbounded",
       [](const R& r) { return relative_range(r); }},
      {"margin", "", "distance of the chosen value from the nearer end, over the width of the range",
       [](const R& r) { return margin_of(r); }},
      {"block_a", "", "of a normal force: block of the joint with the smaller number; -1: another quantity",
       [](const R& r) { return r.joint ? r.joint->first : -1; }},
      {"block_b", "", "of a normal force: the other block of the joint; -1: another quantity",
       [](const R& r) { return r.joint ? r.joint->second : -1; }},
  };
  return columns;
}

const Columns<RingSum>& ring_columns() {
  using R = RingSum;
  static const Columns<R> columns{
      {"ring", "", "the cut runs below this ring", &R::ring},
      {"height_m", "m",
       "mean height of the ring's bed joints, of its bed where it has none, or of its skewbacks", &R::height},
      {"blocks", "", "blocks that begin in the ring", &R::blocks},
      {"joint_force_{}_N", "N", "sum of the forces of joints and ties on the blocks above the cut",
       &R::joint_force},
      {"load_above_N", "N", "vertical part of weight and applied loads above the cut, positive downwards",
       [](const R& r) { return -r.load_above.z(); }},
      {"relative_difference", "", "norm of joint force plus load, over the norm of the load",
       &R::relative_difference},
      {"mean_resultant_N", "N", "mean of the blocks' resultants", &R::mean_resultant},
      {"cv_resultant", "", "coefficient of variation of the blocks' resultants", &R::cv_resultant},
      {"cv_pressure", "", "coefficient of variation of the blocks' bed pressures", &R::cv_pressure},
      {"radial_thrust_N", "N",
       "sum of the forces on the blocks below the ring, and of the ring on supports, along the outward "
       "direction at the centroid of each joint; empty: no vault",
       &R::radial_thrust},
      {"largest_couple_length_m", "m", "largest couple length of a block's wrench",
       &R::largest_couple_length},
      {"largest_friction_use", "", "largest friction utilisation of a bed joint", &R::largest_friction_use},
      {"largest_kern_use", "",
       "largest kern utilisation of a bed joint; above 1: part of the joint is unloaded or pulls",
       &R::largest_kern},
  };
  return columns;
}

const Columns<JointWrench>& joint_columns() {
  using J = JointWrench;
  static const Columns<J> columns{
      {"block_a", "", "first block", &J::block_a},
      {"block_b", "", "second block", &J::block_b},
      {"kind", "", names_and_codes<JointKind>(), &J::kind},
      {"ring", "", "ring of the joint's upper part", &J::ring},
      {"{}_m", "m", "centre of pressure", [](const J& j) { return j.wrench.point; }},
      {"force_{}_N", "N", "resultant on the second block", [](const J& j) { return j.wrench.force; }},
      {"moment_{}_Nm", "N m", "moment on the second block about the centre of pressure",
       [](const J& j) { return j.wrench.moment; }},
      {"axis_{}_m", "m", "point on the central axis", [](const J& j) { return j.axis.point; }},
      {"couple_length_m", "m", "couple over force on the central axis", &J::couple_length},
      {"normal_force_N", "N", "sum of the normal forces of the contact points", &J::normal_force},
      {"area_m2", "m2",
       "area of the joint, without what opens beyond `contact.margin`; in a limit of `joint_extent` that of "
       "the shrunk joint, to which its edge, kern and pressure belong, too",
       [](const J& j) { return j.area; }},
      {"eccentricity_m", "m", "distance of the centre of pressure from the joint's centroid",
       &J::eccentricity},
      {"edge_distance_m", "m", "distance of the centre of pressure from the joint's edge, negative outside",
       &J::edge_distance},
      {"kern_use", "", "kern utilisation; up to 1 the force lies in the kern", &J::kern},
      {"friction_use", "", "tangential force over the largest possible one; 1: the joint slides",
       &J::friction_use},
      {"opening_m", "m", "widest opening at its points: gap, or crack where joints have strength",
       &J::opening},
      {"open_share", "", "share of this area that carries no normal force, without cracks that still pull",
       &J::open_share},
      {"slip_m", "m", "largest accumulated slip of its points", &J::slip},
      {"largest_pressure_Pa", "Pa", "largest normal force of a contact point over its area",
       &J::largest_pressure},
      {"strength_use", "",
       "largest share of the compressive or tensile strength that a contact point uses; empty: dry joint",
       &J::strength_use},
      {"damage", "", "lost share of tension and cohesion, mean over the area; empty: has neither",
       &J::damage},
      {"force_magnitude_N", "N", "norm of the resultant", [](const J& j) { return j.wrench.force.norm(); },
       false},
      {"normal", "", "unit normal, from the first block to the second",
       [](const J& j) { return j.patch.plane.normal; }, false},
  };
  return columns;
}

const Columns<BlockRow>& block_columns() {
  using B = BlockRow;
  static const Columns<B> columns{
      {"block", "", "index in the assembly", &B::index},
      {"kind", "", names_and_codes<BlockKind>(), [](const B& b) { return b.block.kind; }},
      {"ring", "", "first ring of the block; in blocks_NNNN.vtu, ring of the part", &B::ring},
      {"slot", "", "place in the first ring", [](const B& b) { return b.block.slot; }},
      {"rib", "", "1: spans a corner of the vault", [](const B& b) { return b.block.rib ? 1 : 0; }},
      {"beside_spiral", "", "1: laid flat, with a head joint to a herringbone block", &B::beside_spiral},
      {"{}_m", "m", "centroid in the assembly", [](const B& b) { return b.block.centroid; }},
      {"weight_N", "N", "weight under full gravity", &B::weight},
      {"force_{}_N", "N", "force from the ring below", [](const B& b) { return b.from_below.force; }},
      {"moment_{}_Nm", "N m", "moment from the ring below, about the centroid",
       [](const B& b) { return b.from_below.moment; }},
      {"resultant_N", "N", "norm of the force from the ring below, through joints alone, without ties",
       [](const B& b) { return b.fields.resultant; }},
      {"axis_{}_m", "m", "point on the wrench's central axis nearest to the centroid",
       [](const B& b) { return b.axis.point; }},
      {"couple_length_m", "m", "couple over force on the central axis",
       [](const B& b) { return b.fields.couple_length; }},
      {"meridional_force_N_per_m", "N/m", "meridional force per metre of ring, compression positive",
       [](const B& b) { return b.fields.meridional_force; }},
      {"hoop_force_N_per_m", "N/m", "hoop force per metre of meridian, compression positive",
       [](const B& b) { return b.fields.hoop_force; }},
      {"friction_use", "", "largest friction utilisation of its joints",
       [](const B& b) { return b.fields.friction_use; }},
      {"kern_use", "", "largest kern utilisation of its bed joints",
       [](const B& b) { return b.fields.kern; }},
      {"opening_m", "m", "widest opening of its joints", [](const B& b) { return b.fields.opening; }},
      {"slip_m", "m", "largest accumulated slip at its joints", [](const B& b) { return b.fields.slip; }},
      {"displacement_{}_m", "m", "displacement of the centroid, relative to the ground", &B::displacement},
      {"mechanism_group", "", "blocks of one number move as one body", &B::mechanism_group},
      {"couple_{}_Nm", "N m", "couple of the wrench from the ring below, parallel to its force",
       [](const B& b) { return b.axis.couple; }, false},
      {"member", "", "number of its wythe or group of bonders, see assembly.vtu; 0 without wythes",
       [](const B& b) { return b.block.member; }, false},
  };
  return columns;
}

// clang-format on

}  // namespace cupola
