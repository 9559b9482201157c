#include <limits>

#include "postproc/tables/result_columns.hpp"

namespace cupola {
namespace {

/// NaN for the anchor of a tie alone, which has no length.
double per_metre(double force, const Reaction& reaction) {
  return reaction.length > 0.0 ? force / reaction.length : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

// clang-format off: one line per column.

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
      {"outward_force_N", "N",
       "sum of its horizontal outward forces on the blocks below the cut; empty: no vault",
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
      {"area_m2", "m2", "area of these joints, without what opens beyond `contact.margin`",
       [](const W& w) { return w.sum.area; }},
      {"vertical_force_N", "N",
       "vertical force through its joints on the blocks above the cut, positive upwards",
       [](const W& w) { return w.sum.vertical_force; }},
      {"share", "", "this force over the sum of the ring", [](const W& w) { return w.sum.share; }},
      {"outward_force_N", "N",
       "sum of the horizontal outward forces through its joints on the blocks below; empty: no vault",
       [](const W& w) { return w.sum.outward_force; }},
      {"position", "",
       "mean place of the normal forces on its beds through its thickness: 0 inner, 1 outer side; empty: "
       "none",
       [](const W& w) { return w.sum.position; }},
      {"pressure_Pa", "Pa", "normal force on its bed joints over this area",
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

const Columns<HoopRow>& hoop_columns() {
  using H = HoopRow;
  static const Columns<H> columns{
      {"ring", "", "ring of the joints' upper part", &H::ring},
      {"height_m", "m", "mean height of the joints crossed; without any, of a tie", &H::height},
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
      {"yielding_bars", "", "bars at their yield force", &C::yielding},
      {"yielded_m", "m", "plastic elongation of all bars together", &C::yielded},
  };
  return columns;
}

const Columns<Reaction>& reaction_columns() {
  using S = Reaction;
  static const Columns<S> columns{
      {"support", "", "index of the fixed block", &S::block},
      {"force_{}_N", "N", "of the structure on the support", &S::force},
      {"outward_force_N", "N",
       "sum of its joints, without ties, along the outward direction at the centroid of each, of an arch "
       "away from the middle of its stones, of a pier under several vaults that of one; empty: no vault",
       &S::outward},
      {"length_m", "m",
       "of its joints along the course, area over the thickness of the wythes; empty: none, as of the cut "
       "back of a "
       "rib or of shrunk joints",
       &S::length},
      {"vertical_N_per_m", "N/m", "downwards on the support, per metre of support",
       [](const S& r) { return per_metre(-r.force.z(), r); }},
      {"outward_N_per_m", "N/m", "outwards, per metre of support",
       [](const S& r) { return per_metre(r.outward, r); }},
  };
  return columns;
}

const Columns<TieRow>& tie_columns() {
  using T = TieRow;
  static const Columns<T> columns{
      {"chain", "", "name of its chain; empty: none", &T::chain},
      {"block_a", "", "block at one end", [](const T& t) { return t.ties.block_a[t.index]; }},
      {"block_b", "", "block at the other end", [](const T& t) { return t.ties.block_b[t.index]; }},
      {"a_{}_m", "m", "end on the first block; of a restraint behind `b` in its direction",
       [](const T& t) { return t.ties.point_a[t.index]; }},
      {"b_{}_m", "m", "end on the second block", [](const T& t) { return t.ties.point_b[t.index]; }},
      {"force_N", "N", "tension; of a strut thrust", [](const T& t) { return t.ties.force[t.index]; }},
      {"yield_force_N", "N", "tension at which it yields; inf: elastic without limit",
       [](const T& t) { return t.ties.yield_force[t.index]; }},
      {"yielded_m", "m", "plastic elongation", [](const T& t) { return t.ties.yielded[t.index]; }},
      {"strut", "", "1: resists shortening", [](const T& t) { return t.ties.strut[t.index] != 0 ? 1 : 0; }},
  };
  return columns;
}

// clang-format on

}  // namespace cupola
