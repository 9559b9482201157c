#include "postproc/tables/result_tables.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace cupola {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Per block, 1 for a block laid flat that has a head joint with a herringbone block.
std::vector<int> beside_spiral(const Evaluation& e) {
  std::vector<int> beside(e.assembly.blocks.size(), 0);
  const auto upright = [&e](int b) { return e.assembly.blocks[b].kind == BlockKind::herringbone; };
  for (const JointWrench& j : e.last.joints.wrenches) {
    if (j.kind != JointKind::head) continue;
    const int a = j.block_a, b = j.block_b;
    if (upright(b) && !upright(a)) beside[static_cast<size_t>(a)] = 1;
    if (upright(a) && !upright(b)) beside[static_cast<size_t>(b)] = 1;
  }
  return beside;
}

}  // namespace

Table ring_table(const Evaluation& e) {
  Table t{"rings", "Ring cuts: what the joints below each ring carry, against the load above", {}, {}};
  t.columns = {
      {"ring", "", "first ring of the blocks above the cut"},
      {"height_m", "m", "mean height of the ring's bed joints"},
      {"blocks", "", "blocks that begin in the ring"},
      {"joint_force_x_N", "N", "sum of the joint forces on the blocks above"},
      {"joint_force_y_N", "N", ""},
      {"joint_force_z_N", "N", ""},
      {"load_above_N", "N", "weight and applied loads above the cut, downwards"},
      {"relative_difference", "", "|sum of forces and loads| / |loads|"},
      {"mean_resultant_N", "N", "mean of the block resultants"},
      {"cv_resultant", "", "coefficient of variation of the block resultants"},
      {"cv_pressure", "", "coefficient of variation of the blocks' bed pressures"},
      {"radial_thrust_N", "N", "sum of the outward forces on the ring below"},
      {"largest_couple_length_m", "m", "largest couple length of a block's wrench"},
      {"largest_friction_use", "", "largest friction utilisation of a bed joint"},
      {"largest_kern_use", "", "largest eccentricity over the kern's; > 1: part of a joint unloaded"}};
  for (const RingSum& r : e.rings)
    t.rows.push_back({r.ring, r.height, r.blocks, r.joint_force.x(), r.joint_force.y(), r.joint_force.z(),
                      r.load_above.dot(-e.up), r.relative_difference, r.mean_resultant, r.cv_resultant,
                      r.cv_pressure, r.radial_thrust, r.largest_couple_length, r.largest_friction_use,
                      r.largest_kern});
  return t;
}

Table joint_table(const Evaluation& e) {
  Table t{"joints", "Wrench on every joint, on its second block, about the centre of pressure", {}, {}};
  t.columns = {{"block_a", "", "first block"},
               {"block_b", "", "second block"},
               {"kind", "", "bed, head, base or other"},
               {"ring", "", "course of the upper part"},
               {"x_m", "m", "centre of pressure"},
               {"y_m", "m", ""},
               {"z_m", "m", ""},
               {"force_x_N", "N", "resultant"},
               {"force_y_N", "N", ""},
               {"force_z_N", "N", ""},
               {"moment_x_Nm", "N m", "moment about the centre of pressure"},
               {"moment_y_Nm", "N m", ""},
               {"moment_z_Nm", "N m", ""},
               {"axis_x_m", "m", "point of the central axis"},
               {"axis_y_m", "m", ""},
               {"axis_z_m", "m", ""},
               {"couple_length_m", "m", "couple over force on the central axis"},
               {"normal_force_N", "N", "sum of the normal forces"},
               {"area_m2", "m2", "of the joint"},
               {"eccentricity_m", "m", "centre of pressure from the joint's centroid"},
               {"edge_distance_m", "m", "centre of pressure from the joint's edge"},
               {"kern_use", "", "<= 1: the force lies in the kern"},
               {"friction_use", "", "1: every point slides"},
               {"opening_m", "m", "largest gap"},
               {"open_share", "", "share of the area without force"},
               {"slip_m", "m", "largest slip"}};
  for (const JointWrench& j : e.last.joints.wrenches) {
    const Vec3 &p = j.wrench.point, &f = j.wrench.force, &m = j.wrench.moment, &a = j.axis.point;
    t.rows.push_back({j.block_a,
                      j.block_b,
                      to_string(j.kind),
                      j.ring,
                      p.x(),
                      p.y(),
                      p.z(),
                      f.x(),
                      f.y(),
                      f.z(),
                      m.x(),
                      m.y(),
                      m.z(),
                      a.x(),
                      a.y(),
                      a.z(),
                      j.axis.couple_length,
                      j.normal_force,
                      j.patch.area,
                      j.eccentricity,
                      j.edge_distance,
                      j.kern,
                      j.friction_use,
                      j.opening,
                      j.open_share,
                      j.slip});
  }
  return t;
}

Table block_table(const Evaluation& e) {
  Table t{"blocks", "Every block: the wrench from the ring below, shell forces, joints, movement", {}, {}};
  t.columns = {{"block", "", "number in the assembly"},
               {"kind", "", ""},
               {"ring", "", "first ring"},
               {"slot", "", "place in the ring"},
               {"rib", "", "1: spans a corner of the vault"},
               {"beside_spiral", "", "1: a block laid flat with a head joint to an upright one"},
               {"x_m", "m", "centroid in the assembly"},
               {"y_m", "m", ""},
               {"z_m", "m", ""},
               {"weight_N", "N", ""},
               {"force_x_N", "N", "wrench from the ring below, about the centroid"},
               {"force_y_N", "N", ""},
               {"force_z_N", "N", ""},
               {"moment_x_Nm", "N m", ""},
               {"moment_y_Nm", "N m", ""},
               {"moment_z_Nm", "N m", ""},
               {"resultant_N", "N", "its norm"},
               {"axis_x_m", "m", "point of its central axis nearest to the centroid"},
               {"axis_y_m", "m", ""},
               {"axis_z_m", "m", ""},
               {"couple_length_m", "m", "couple over force on that axis"},
               {"meridional_force_N_per_m", "N/m", "per metre of ring, compression positive"},
               {"hoop_force_N_per_m", "N/m", "per metre of meridian, compression positive"},
               {"friction_use", "", "largest of its joints"},
               {"kern_use", "", "largest of its bed joints"},
               {"opening_m", "m", "largest gap at its joints"},
               {"slip_m", "m", "largest slip at its joints"},
               {"displacement_x_m", "m", ""},
               {"displacement_y_m", "m", ""},
               {"displacement_z_m", "m", ""},
               {"mechanism_group", "", "blocks that move as one body"}};
  const double g = e.scene.loads.gravity.norm();
  const std::vector<int> beside = beside_spiral(e);
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b) {
    const Block& block = e.assembly.blocks[b];
    const BlockFields& v = e.last.fields[b];
    const Wrench& w = e.last.from_below[b];
    const CentralAxis axis = central_axis(w);
    const Vec3& d = e.last.frame.blocks.displacement[b];
    t.rows.push_back({static_cast<int>(b),
                      to_string(block.kind),
                      block.ring,
                      block.slot,
                      block.rib ? 1 : 0,
                      beside[b],
                      block.centroid.x(),
                      block.centroid.y(),
                      block.centroid.z(),
                      block.mass * g,
                      w.force.x(),
                      w.force.y(),
                      w.force.z(),
                      w.moment.x(),
                      w.moment.y(),
                      w.moment.z(),
                      v.resultant,
                      axis.point.x(),
                      axis.point.y(),
                      axis.point.z(),
                      v.couple_length,
                      v.meridional_force,
                      v.hoop_force,
                      v.friction_use,
                      v.kern,
                      v.opening,
                      v.slip,
                      d.x(),
                      d.y(),
                      d.z(),
                      e.last.groups[b]});
  }
  return t;
}

Table thrust_table(const ThrustLine& line) {
  Table t{"thrust_" + line.name, "Thrust line of the meridian " + line.name, {}, {}};
  t.columns = {{"bed", "", "counted from the springing"},
               {"height_m", "m", "of the bed's middle"},
               {"blocks", "", "blocks that the strip meets"},
               {"x_m", "m", "point of the thrust line"},
               {"y_m", "m", ""},
               {"z_m", "m", ""},
               {"position", "",
                "through the thickness: 0 intrados, 1 extrados; nan: none, the resultant runs along the bed"},
               {"r_N", "N", "norm of the resultant"},
               {"v_N", "N", "its vertical component"},
               {"force_x_N", "N", "resultant on the part above, in the meridian plane"},
               {"force_y_N", "N", ""},
               {"force_z_N", "N", ""},
               {"couple_length_m", "m", ""},
               {"face_distance_m", "m", "to the nearer face; negative outside"},
               {"geometric_safety", "", "half the thickness over the eccentricity"}};
  for (const ThrustPoint& p : line.points)
    t.rows.push_back({p.bed, p.height(), p.blocks, p.point.x(), p.point.y(), p.point.z(), p.position, p.r,
                      p.v, p.force.x(), p.force.y(), p.force.z(), p.couple_length, p.face_distance,
                      p.geometric_safety});
  return t;
}

Table hoop_table(const MeridianEvaluation& m) {
  Table t{"hoop_" + m.thrust.name, "Hoop forces across the meridian " + m.thrust.name, {}, {}};
  t.columns = {{"ring", "", "course of the joints' upper part"},
               {"height_m", "m", "mean of the joints crossed"},
               {"head_force_N", "N", "through head joints, compression positive"},
               {"bed_force_N", "N", "through beds, compression positive"},
               {"hoop_force_N", "N", "their sum"}};
  for (const HoopRow& row : m.hoop)
    t.rows.push_back({row.ring, row.height, row.head_force, row.bed_force, row.head_force + row.bed_force});
  return t;
}

Table section_table(const Evaluation& e, const SectionEvaluation& section) {
  Table t{fmt::format("section_{:g}m", section.height),
          fmt::format("Resultants of the blocks across the bed nearest to z = {:g} m (ring {})",
                      section.height, section.ring),
          {},
          {}};
  t.columns = {{"block", "", ""},
               {"kind", "", ""},
               {"azimuth_deg", "deg", "of the resultant's point on the bed"},
               {"x_m", "m", "point of the resultant's line of action at the bed's mean height"},
               {"y_m", "m", ""},
               {"z_m", "m", ""},
               {"force_x_N", "N", "resultant on the part above the bed"},
               {"force_y_N", "N", ""},
               {"force_z_N", "N", ""},
               {"resultant_N", "N", ""},
               {"couple_length_m", "m", ""}};
  for (const BedResultant& r : section.resultants) {
    const Vec3 &x = r.point, &f = r.wrench.force;
    t.rows.push_back({r.block, to_string(e.assembly.blocks[r.block].kind), azimuth(x) * kDegrees, x.x(),
                      x.y(), x.z(), f.x(), f.y(), f.z(), f.norm(), r.couple_length});
  }
  return t;
}

Table plane_table(const Evaluation& e, const PlaneCut& cut) {
  Table t{"cut_" + cut.name, "Joints across the plane " + cut.name, {}, {}};
  t.columns = {{"block_a", "", "first block"},
               {"block_b", "", "second block"},
               {"kind", "", "bed, head, base or other"},
               {"ring", "", "course of the upper part"},
               {"x_m", "m", "centre of pressure"},
               {"y_m", "m", ""},
               {"z_m", "m", ""},
               {"force_x_N", "N", "on the block beyond the plane"},
               {"force_y_N", "N", ""},
               {"force_z_N", "N", ""},
               {"through_N", "N", "in the plane's normal, compression positive"},
               {"along_N", "N", "in the plane"}};
  for (const int j : cut.joints) {
    const JointWrench& joint = e.last.joints.wrenches[j];
    const Vec3 &x = joint.centre_of_pressure, f = force_beyond(cut, e.assembly, joint);
    const double through = f.dot(cut.normal);
    t.rows.push_back({joint.block_a, joint.block_b, to_string(joint.kind), joint.ring, x.x(), x.y(), x.z(),
                      f.x(), f.y(), f.z(), through, (f - through * cut.normal).norm()});
  }
  return t;
}

std::vector<Table> result_tables(const Evaluation& e) {
  std::vector<Table> tables;
  if (!e.rings.empty()) tables.push_back(ring_table(e));
  for (const MeridianEvaluation& m : e.meridians) {
    tables.push_back(thrust_table(m.thrust));
    if (!m.hoop.empty()) tables.push_back(hoop_table(m));
  }
  for (const SectionEvaluation& section : e.sections) tables.push_back(section_table(e, section));
  for (const PlaneCut& cut : e.planes) tables.push_back(plane_table(e, cut));
  tables.push_back(joint_table(e));
  tables.push_back(block_table(e));
  return tables;
}

}  // namespace cupola
