#include "postproc/tables/result_columns.hpp"

namespace cupola {

// clang-format off: one line per column.

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
      {"force_{}_N", "N",
       "resultant on the part above (beyond the crown of an arch: below), turned into the meridian plane",
       &P::force},
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
      {"azimuth_deg", "deg", "of its middle, weighted by width; of a turned member in its own frame",
       [](const C& c) { return c.crack.azimuth * kDegrees; }},
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
      {"azimuth_deg", "deg", "azimuth of the resultant's point; of a turned member in its own frame",
       [](const R& r) { return r.azimuth * kDegrees; }},
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
