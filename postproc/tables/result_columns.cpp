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

/// Per block, 1 for a block laid flat that has a head joint with a herringbone block.
std::vector<int> beside_spiral(const Assembly& assembly, const JointWrenches& joints) {
  std::vector<int> beside(assembly.blocks.size(), 0);
  const auto upright = [&](int b) { return assembly.blocks[b].kind == BlockKind::herringbone; };
  for (const JointWrench& joint : joints.wrenches) {
    if (joint.kind != JointKind::head) continue;
    const int a = joint.block_a, b = joint.block_b;
    if (upright(b) && !upright(a)) beside[a] = 1;
    if (upright(a) && !upright(b)) beside[b] = 1;
  }
  return beside;
}

double or_nan(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

std::vector<BlockRow> block_rows(const Evaluation& e, const FrameEvaluation& frame) {
  const double g = e.scene.loads.gravity.norm();
  const std::vector<int> beside = beside_spiral(e.assembly, frame.joints);
  std::vector<BlockRow> rows;
  rows.reserve(e.assembly.blocks.size());
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b) {
    const Block& block = e.assembly.blocks[b];
    rows.push_back({.block = block,
                    .fields = frame.fields[b],
                    .from_below = frame.from_below[b],
                    .axis = central_axis(frame.from_below[b]),
                    .displacement = frame.frame.blocks.displacement[b],
                    .weight = block.mass * g,
                    .index = static_cast<int>(b),
                    .ring = block.ring,
                    .beside_spiral = beside[b],
                    .mechanism_group = frame.groups[b]});
  }
  return rows;
}

std::vector<MemberRow> member_rows(const Evaluation& e) {
  std::vector<MemberRow> rows;
  for (const MemberSum& sum : e.members)
    rows.push_back({sum, e.assembly.members[sum.member], e.rings[sum.ring].height});
  return rows;
}

std::vector<WytheRow> wythe_rows(const Evaluation& e) {
  std::vector<WytheRow> rows;
  const std::vector<std::string>& names = e.assembly.members;
  for (const WytheSum& sum : e.wythes) {
    const std::string &first = names[sum.wythes.from], &last = names[sum.wythes.to - 1];
    rows.push_back({sum, sum.wythes.count() > 1 ? fmt::format("{} to {}", first, last) : first,
                    e.rings[sum.ring].height});
  }
  return rows;
}

std::vector<PlaneJoint> plane_joints(const Evaluation& e, const PlaneCut& cut) {
  std::vector<PlaneJoint> rows;
  for (const int j : cut.joints) {
    const JointWrench& joint = e.last.joints.wrenches[j];
    const Vec3 force = force_beyond(cut, e.assembly, joint);
    const double through = force.dot(cut.normal);
    rows.push_back({joint, force, through, (force - through * cut.normal).norm()});
  }
  return rows;
}

std::vector<CrackRow> crack_rows(const Evaluation& e) {
  std::vector<CrackRow> rows;
  for (const ShellCrack& crack : e.cracks) rows.push_back({crack, static_cast<int>(rows.size())});
  return rows;
}

std::vector<TieRow> tie_rows(const Evaluation& e) {
  std::vector<TieRow> rows;
  const TieTable& ties = e.last.frame.ties;
  for (int i = 0; i < ties.size(); ++i)
    rows.push_back({ties, i, ties.chain[i] < 0 ? "" : e.assembly.chains.at(ties.chain[i]).name});
  return rows;
}

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
      {"min_outcome", "", "bounded, unbounded or unconverged",
       [](const R& r) { return to_string(r.min.outcome); }},
      {"max_outcome", "", "bounded, unbounded or unconverged",
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

const Columns<RingRow>& ring_columns() {
  using R = RingRow;
  static const Columns<R> columns{
      {"ring", "", "the cut runs below this ring", [](const R& r) { return r.cut.ring; }},
      {"height_m", "m", "mean height of the ring's bed joints", [](const R& r) { return r.cut.height; }},
      {"blocks", "", "blocks that begin in the ring", [](const R& r) { return r.cut.blocks; }},
      {"joint_force_{}_N", "N", "sum of the joint forces on the blocks above the cut",
       [](const R& r) { return r.cut.joint_force; }},
      {"load_above_N", "N", "weight and applied loads above the cut, positive downwards",
       [](const R& r) { return r.cut.load_above.dot(-r.up); }},
      {"relative_difference", "", "norm of joint force plus load, over the norm of the load",
       [](const R& r) { return r.cut.relative_difference; }},
      {"mean_resultant_N", "N", "mean of the blocks' resultants",
       [](const R& r) { return r.cut.mean_resultant; }},
      {"cv_resultant", "", "coefficient of variation of the blocks' resultants",
       [](const R& r) { return r.cut.cv_resultant; }},
      {"cv_pressure", "", "coefficient of variation of the blocks' bed pressures",
       [](const R& r) { return r.cut.cv_pressure; }},
      {"radial_thrust_N", "N",
       "sum of the forces of its joints on the ring below along the outward direction at the centroid of "
       "each",
       [](const R& r) { return r.cut.radial_thrust; }},
      {"largest_couple_length_m", "m", "largest couple length of a block's wrench",
       [](const R& r) { return r.cut.largest_couple_length; }},
      {"largest_friction_use", "", "largest friction utilisation of a bed joint",
       [](const R& r) { return r.cut.largest_friction_use; }},
      {"largest_kern_use", "",
       "largest kern utilisation of a bed joint; above 1: part of the joint is unloaded",
       [](const R& r) { return r.cut.largest_kern; }},
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
      {"area_m2", "m2", "area of the joint", [](const J& j) { return j.patch.area; }},
      {"eccentricity_m", "m", "distance of the centre of pressure from the joint's centroid",
       &J::eccentricity},
      {"edge_distance_m", "m", "distance of the centre of pressure from the joint's edge", &J::edge_distance},
      {"kern_use", "", "kern utilisation; up to 1 the force lies in the kern", &J::kern},
      {"friction_use", "", "friction utilisation; 1: every point slides", &J::friction_use},
      {"opening_m", "m", "largest gap of its points", &J::opening},
      {"open_share", "", "share of the area that carries no normal force", &J::open_share},
      {"slip_m", "m", "largest accumulated slip of its points", &J::slip},
      {"largest_pressure_Pa", "Pa", "largest normal force of a contact point over its area",
       &J::largest_pressure},
      {"strength_use", "",
       "largest share of the compressive or tensile strength that a contact point uses; empty: dry joint",
       &J::strength_use},
      {"damage", "", "lost share of tension and cohesion, mean over the area; empty: dry joint", &J::damage},
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
      {"resultant_N", "N", "norm of the force from the ring below",
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
      {"opening_m", "m", "largest gap at its joints", [](const B& b) { return b.fields.opening; }},
      {"slip_m", "m", "largest accumulated slip at its joints", [](const B& b) { return b.fields.slip; }},
      {"displacement_{}_m", "m", "displacement of the centroid", &B::displacement},
      {"mechanism_group", "", "blocks of one number move as one body", &B::mechanism_group},
      {"couple_{}_Nm", "N m", "couple of the wrench from the ring below, parallel to its force",
       [](const B& b) { return b.axis.couple; }, false},
      {"member", "", "number of its wythe or group of bonders, see assembly.vtu; 0 without wythes",
       [](const B& b) { return b.block.member; }, false},
  };
  return columns;
}

const Columns<MemberRow>& member_columns() {
  using M = MemberRow;
  static const Columns<M> columns{
      {"ring", "", "the cut runs below this ring", [](const M& m) { return m.sum.ring; }},
      {"height_m", "m", "mean height of the ring's bed joints", &M::height},
      {"member", "", "wythe or group of bonders", &M::name},
      {"blocks", "", "its blocks that begin in the ring", [](const M& m) { return m.sum.blocks; }},
      {"weight_N", "N", "weight of these blocks", [](const M& m) { return m.sum.weight; }},
      {"vertical_force_N", "N", "vertical force from below the cut on its blocks above, positive upwards",
       [](const M& m) { return m.sum.vertical_force; }},
      {"share", "", "this force over the sum of all members", [](const M& m) { return m.sum.share; }},
      {"outward_force_N", "N", "sum of its horizontal outward forces on the blocks below the cut",
       [](const M& m) { return m.sum.outward_force; }},
  };
  return columns;
}

const Columns<WytheRow>& wythe_columns() {
  using W = WytheRow;
  static const Columns<W> columns{
      {"ring", "", "the cut runs below this ring", [](const W& w) { return w.sum.ring; }},
      {"height_m", "m", "mean height of the ring's bed joints", &W::height},
      {"wythe", "", "in which the joints lie; A to B: joints between bonders, which lie in several",
       &W::name},
      {"joints", "", "its bed joints under blocks that begin in the ring",
       [](const W& w) { return w.sum.joints; }},
      {"area_m2", "m2", "area of these joints", [](const W& w) { return w.sum.area; }},
      {"vertical_force_N", "N",
       "vertical force through its joints on the blocks above the cut, positive upwards",
       [](const W& w) { return w.sum.vertical_force; }},
      {"share", "", "this force over the sum of the ring", [](const W& w) { return w.sum.share; }},
      {"outward_force_N", "N", "sum of the horizontal outward forces through its joints on the blocks below",
       [](const W& w) { return w.sum.outward_force; }},
      {"position", "",
       "mean place of the normal forces on its beds through its thickness: 0 inner, 1 outer side; empty: "
       "none",
       [](const W& w) { return w.sum.position; }},
      {"pressure_Pa", "Pa", "normal force on its bed joints over their area",
       [](const W& w) { return w.sum.pressure; }},
      {"cv_pressure", "", "coefficient of variation of the pressure of its bed joints",
       [](const W& w) { return w.sum.cv_pressure; }},
      {"largest_friction_use", "", "largest friction utilisation of its bed joints",
       [](const W& w) { return w.sum.largest_friction_use; }},
      {"largest_kern_use", "", "largest kern utilisation of its bed joints",
       [](const W& w) { return w.sum.largest_kern; }},
  };
  return columns;
}

const Columns<ThrustPoint>& thrust_columns() {
  using P = ThrustPoint;
  static const Columns<P> columns{
      {"bed", "", "bed, counted from the springing", &P::bed},
      {"height_m", "m", "height of the bed's middle", &P::height},
      {"blocks", "", "number of blocks in the strip", &P::blocks},
      {"{}_m", "m", "point of the thrust line", &P::point},
      {"position", "",
       "position through the thickness: 0 intrados, 1 extrados; empty: the resultant is negligible or runs "
       "along the bed",
       &P::position},
      {"r_N", "N", "norm of the resultant", &P::r},
      {"v_N", "N", "vertical component of the resultant", &P::v},
      {"force_{}_N", "N", "resultant on the part above, turned into the meridian plane", &P::force},
      {"couple_length_m", "m", "couple over force on the central axis", &P::couple_length},
      {"face_distance_m", "m", "distance to the nearer face, negative outside", &P::face_distance},
      {"geometric_safety", "", "half the thickness over the eccentricity", &P::geometric_safety},
      {"compressed_from", "", "innermost contact point that pushes on the bed, as position; empty: none does",
       &P::compressed_from},
      {"compressed_to", "", "outermost contact point that pushes on the bed, as position", &P::compressed_to},
      {"pressure_Pa", "Pa", "normal force of the contact points that push over their area", &P::pressure},
  };
  return columns;
}

const Columns<HoopRow>& hoop_columns() {
  using H = HoopRow;
  static const Columns<H> columns{
      {"ring", "", "ring of the joints' upper part", &H::ring},
      {"height_m", "m", "mean height of the joints crossed", &H::height},
      {"head_force_N", "N", "force through head joints, compression positive", &H::head_force},
      {"bed_force_N", "N", "force through bed joints, compression positive", &H::bed_force},
      {"tie_force_N", "N", "of chains and other ties; negative in tension", &H::tie_force},
      {"hoop_force_N", "N", "sum of the three", [](const H& h) { return h.sum(); }},
  };
  return columns;
}

const Columns<ChainForces>& chain_columns() {
  using C = ChainForces;
  static const Columns<C> columns{
      {"chain", "", "name", &C::name},
      {"height_m", "m", "mean height of its bars", &C::height},
      {"bars", "", "number of bars", &C::bars},
      {"mean_force_N", "N", "tension, mean over the length of the chain", &C::mean},
      {"least_force_N", "N", "tension of the least loaded bar", &C::least},
      {"greatest_force_N", "N", "tension of the most loaded bar", &C::greatest},
      {"yield_force_N", "N", "tension at which a bar yields; inf: elastic without limit", &C::yield_force},
      {"slack_bars", "", "bars without tension", &C::slack},
      {"yielding_bars", "", "bars that have elongated plastically", &C::yielding},
      {"yielded_m", "m", "plastic elongation of all bars together", &C::yielded},
  };
  return columns;
}

const Columns<Reaction>& reaction_columns() {
  using S = Reaction;
  static const Columns<S> columns{
      {"support", "", "index of the fixed block", &S::block},
      {"force_{}_N", "N", "of the structure on the support", &S::force},
      {"outward_force_N", "N", "sum of its joints along the outward direction at the centroid of each",
       &S::outward},
      {"length_m", "m", "of its joints along the course, area over thickness; empty: no thickness",
       &S::length},
      {"vertical_N_per_m", "N/m", "downwards on the support, per metre of support",
       [](const S& r) { return -r.force.z() / r.length; }},
      {"outward_N_per_m", "N/m", "outwards, per metre of support",
       [](const S& r) { return r.outward / r.length; }},
  };
  return columns;
}

const Columns<TieRow>& tie_columns() {
  using T = TieRow;
  static const Columns<T> columns{
      {"chain", "", "name of its chain; empty: none", &T::chain},
      {"block_a", "", "block at one end", [](const T& t) { return t.ties.block_a[t.index]; }},
      {"block_b", "", "block at the other end", [](const T& t) { return t.ties.block_b[t.index]; }},
      {"a_{}_m", "m", "end on the first block", [](const T& t) { return t.ties.point_a[t.index]; }},
      {"b_{}_m", "m", "end on the second block", [](const T& t) { return t.ties.point_b[t.index]; }},
      {"force_N", "N", "tension; of a strut thrust", [](const T& t) { return t.ties.force[t.index]; }},
      {"yield_force_N", "N", "tension at which it yields; inf: elastic without limit",
       [](const T& t) { return t.ties.yield_force[t.index]; }},
      {"yielded_m", "m", "plastic elongation", [](const T& t) { return t.ties.yielded[t.index]; }},
      {"strut", "", "1: resists shortening", [](const T& t) { return t.ties.strut[t.index] != 0 ? 1 : 0; }},
  };
  return columns;
}

const Columns<CrackRow>& crack_columns() {
  using C = CrackRow;
  static const Columns<C> columns{
      {"crack", "", "number, the widest first; in cracks.vtp per joint, -1: a hairline", &C::number},
      {"course", "", "meridional: through head joints; parallel: along beds; layers: within the thickness",
       [](const C& c) { return std::string(to_string(c.crack.course)); }},
      {"joints", "", "number of its joints",
       [](const C& c) { return static_cast<int>(c.crack.joints.size()); }},
      {"length_m", "m", "of its joints along the shell", [](const C& c) { return c.crack.length; }},
      {"width_m", "m", "widest gap", [](const C& c) { return c.crack.width; }},
      {"width_inner_m", "m", "widest gap at the inner face", [](const C& c) { return c.crack.width_inner; }},
      {"width_outer_m", "m", "widest gap at the outer face", [](const C& c) { return c.crack.width_outer; }},
      {"through", "", "1: a joint is open at both faces", [](const C& c) { return c.crack.through ? 1 : 0; }},
      {"rotation_deg", "deg", "largest rotation of a joint, outwards opening positive",
       [](const C& c) { return c.crack.rotation * kDegrees; }},
      {"slip_m", "m", "largest accumulated slip of its joints", [](const C& c) { return c.crack.slip; }},
      {"azimuth_deg", "deg", "of its middle, weighted by width",
       [](const C& c) { return azimuth(c.crack.middle) * kDegrees; }},
      {"middle_{}_m", "m", "its middle, weighted by width", [](const C& c) { return c.crack.middle; }},
      {"start_{}_m", "m", "centre of its first joint", [](const C& c) { return c.crack.start; }},
      {"end_{}_m", "m", "centre of its last joint", [](const C& c) { return c.crack.end; }},
  };
  return columns;
}

const Columns<BedResultant>& section_columns() {
  using R = BedResultant;
  static const Columns<R> columns{
      {"block", "", "index in the assembly", &R::block},
      {"kind", "", "standard, herringbone or imported", &R::kind},
      {"azimuth_deg", "deg", "azimuth of the resultant's point",
       [](const R& r) { return azimuth(r.point) * kDegrees; }},
      {"{}_m", "m", "point of the resultant's line of action at the bed's mean height", &R::point},
      {"force_{}_N", "N", "resultant on the part above the bed", [](const R& r) { return r.wrench.force; }},
      {"resultant_N", "N", "norm of the resultant", [](const R& r) { return r.wrench.force.norm(); }},
      {"couple_length_m", "m", "couple over force on the central axis", &R::couple_length},
  };
  return columns;
}

const Columns<PlaneJoint>& plane_columns() {
  using P = PlaneJoint;
  static const Columns<P> columns{
      {"block_a", "", "first block", [](const P& p) { return p.joint.block_a; }},
      {"block_b", "", "second block", [](const P& p) { return p.joint.block_b; }},
      {"kind", "", "bed, head or other", [](const P& p) { return p.joint.kind; }},
      {"ring", "", "ring of the joint's upper part", [](const P& p) { return p.joint.ring; }},
      {"{}_m", "m", "centre of pressure", [](const P& p) { return p.joint.centre_of_pressure; }},
      {"force_{}_N", "N", "force on the block beyond the plane", &P::force},
      {"through_N", "N", "component along the plane's normal, compression positive", &P::through},
      {"along_N", "N", "component in the plane", &P::along},
  };
  return columns;
}

const Columns<LineCell>& line_cell_columns() {
  using C = LineCell;
  static const Columns<C> columns{
      {"what", "",
       "0 thrust line, 1 envelope, 2 line of action, 3 intrados, 4 extrados, 5 thrust line of a wythe",
       &C::what},
      {"meridian", "", "index of the meridian in the case", &C::meridian},
      {"resultant_N", "N", "norm of the resultant on a line of action; 0 elsewhere", &C::resultant},
  };
  return columns;
}

const Columns<SectionCell>& section_cell_columns() {
  using C = SectionCell;
  static const Columns<C> columns{
      {"what", "", "0 force as a segment, 1 outline of a block that is cut", &C::what},
      {"cut", "", "index of the cut: sections first, then planes", &C::cut},
      {"block", "", "index in the assembly", &C::block},
      {"height_m", "m", "height of the section, or of the plane's point", &C::height},
      {"resultant_N", "N", "norm of the force of a segment; 0 for outlines", &C::resultant},
  };
  return columns;
}

// clang-format on

}  // namespace cupola
