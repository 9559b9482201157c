#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/case/declare.hpp"
#include "assembly/files/time_table.hpp"
#include "assembly/model/smooth_motion.hpp"

namespace cupola {
namespace {

void declare_pair(Section& s, PairTie& tie) {
  s.required_block("block_a", tie.block_a, "number or name of the block at one end");
  s.required_block("block_b", tie.block_b, "number or name of the block at the other end");
  s.optional_vector3("point_a", tie.point_a, {.unit = "m"}, "centroid",
                     "anchor on block_a, in the as-built geometry");
  s.optional_vector3("point_b", tie.point_b, {.unit = "m"}, "centroid",
                     "anchor on block_b, in the as-built geometry");
  s.number("stiffness", tie.stiffness, {.unit = "N/m", .above = 0}, "force per unit elongation");
  s.expect({"stiffness", tie.stiffness, "N/m", 1e3, 1e12, "in kN/mm? 1 kN/mm is 1e6 N/m",
            "a modulus in N/m2? Stiffness is modulus times section over length"});
  s.number("prestress", tie.prestress, {.unit = "N", .min = 0}, "tension as built");
  s.number("slack", tie.slack, {.unit = "m", .min = 0}, "elongation at which the tie begins to carry");
  s.optional_number("yield_force", tie.yield_force, {.unit = "N", .above = 0}, "none",
                    "tension at which the tie elongates plastically");
  s.rule(tie.slack == 0.0 || tie.prestress == 0.0, "slack", "a tie has either slack or prestress");
  s.rule(!tie.yield_force || tie.prestress <= *tie.yield_force, "prestress", "must be <= yield_force");
}

/// The ground goes on with the velocity at the end of an accelerogram.
void expect_rest_at_end(Section& s, const BaseMotion& motion, const TableInTime& acceleration) {
  constexpr double kSmall = 0.05;  // of the peak: what corrected records leave, and no drift of the model
  const DisplacementInTime ground = integrate_twice(acceleration);
  double peak = 0.0;
  for (const double velocity : ground.velocity) peak = std::max(peak, std::abs(velocity));
  const double scale = motion.direction.norm();
  s.expect(
      {" (velocity at the end)", scale * std::abs(ground.velocity.back()), "m/s", 0.0, scale * kSmall * peak,
       "",
       fmt::format("the ground keeps this velocity after the end of {}: correct the baseline of the record, "
                   "or use a longer one",
                   motion.file)});
}

/// The ground starts from rest and stops at the end of a record of displacements, within some of its samples.
void expect_rest_at_ends(Section& s, const BaseMotion& motion, const TableInTime& displacement) {
  constexpr size_t kEnd = 5;  // samples that the jolt at an end reaches in the spline, to below 1 %
  constexpr double kJolt =
      4.0;  // times what the motion between has: no record that starts from rest has that
  const std::vector<double> a = interpolate_smoothly(displacement).acceleration.values;
  if (a.size() <= 2 * kEnd) return;
  double between = 0.0;
  for (size_t i = kEnd; i + kEnd < a.size(); ++i) between = std::max(between, std::abs(a[i]));
  const double scale = motion.direction.norm();
  s.expect(
      {" (acceleration at an end)", scale * std::max(std::abs(a.front()), std::abs(a.back())), "m/s2", 0.0,
       scale * kJolt * between, "",
       fmt::format("{} starts or ends at speed, which the ground takes up or loses within a sample: use a "
                   "longer record",
                   motion.file)});
}

void declare_base_motion(Section& s, BaseMotion& motion) {
  s.file("file", motion.file, "two columns: time (s) and value (m or m/s2)");
  s.choice(
      "quantity", motion.quantity,
      "quantity in the second column; a displacement is interpolated by a cubic spline, at rest before and "
      "after; an acceleration is integrated from rest, without baseline correction, and is 0 after its end");
  s.vector3("direction", motion.direction, {},
            "direction of the motion; its length scales the values of the file");
  s.rule(!motion.file.empty(), "file", "must be given: a file with the columns time and value");
  if (motion.file.empty()) return;  // while the keys are described
  const TableInTime table = read_time_table(motion.file);
  double peak = 0.0;
  for (const double value : table.values) peak = std::max(peak, std::abs(value));
  peak *= motion.direction.norm();
  if (motion.quantity == BaseMotion::Quantity::displacement) {
    s.expect({" (largest displacement)", peak, "m", 1e-5, 10.0, kKilometres,
              "in mm or cm? Multiply direction by 0.001 or 0.01"});
    expect_rest_at_ends(s, motion, table);
    return;
  }
  s.expect({" (largest acceleration)", peak, "m/s2", 0.1, 50.0, "in g? Multiply direction by 9.81",
            "in cm/s2 (gal)? Multiply direction by 0.01"});
  s.rule(table.times.front() >= 0.0, "file",
         fmt::format("its first time is {:g} s. Accelerations are integrated from rest, and the analysis "
                     "starts at 0 s: shift the times so that the first is 0 or later",
                     table.times.front()));
  expect_rest_at_end(s, motion, table);
}

void declare_sector(Section& s, Sector& sector) {
  s.required_number("from_deg", sector.from_deg, {.unit = "deg", .min = -360, .max = 360},
                    "azimuth about the axis of the vault, from its x axis, at which the sector begins");
  s.required_number(
      "to_deg", sector.to_deg, {.unit = "deg", .min = -360, .max = 720},
      "azimuth at which it ends, counter-clockwise; a block there belongs to a sector that begins there");
  s.rule(sector.to_deg > sector.from_deg && sector.to_deg - sector.from_deg <= 360.0, "to_deg",
         "must be above from_deg, by at most 360");
}

void declare_profile(Section& s, AzimuthProfile& profile) {
  s.required_integer("cos", profile.waves, {.min = 1, .max = 1000},
                     "waves m around the axis of the vault: the factor is cos(m (azimuth - phase))");
  s.number("phase_deg", profile.phase_deg, {.unit = "deg"}, "azimuth of a crest, from its x axis");
}

void declare_move(Section& s, SupportMove& move) {
  declare_region(s, move.region, "the fixed blocks that move; empty: all fixed blocks");
  s.vector3("displacement", move.displacement, {.unit = "m"}, "displacement");
  s.number("outward", move.outward, {.unit = "m"},
           "displacement of each block away from the axis of the vault on it, horizontally, in addition");
  s.number("tilt_deg", move.tilt_deg, {.unit = "deg"},
           "rotation of each block about its centroid, by which its top turns outwards, in addition");
  s.vector3("rotation_deg", move.rotation_deg, {.unit = "deg"}, "rotation vector");
  s.vector3("pivot", move.pivot, {.unit = "m"}, "centre of the rotation");
  declare_time(s, "time", move.time, "factor on the motion");
}

void declare_ramp(Section& s, RampInTime& ramp) {
  s.number("from", ramp.from, {}, "factor before the ramp");
  s.number("to", ramp.to, {}, "factor after the ramp");
  s.number("start", ramp.start, {.unit = "s"}, "time at which the ramp starts");
  s.number("duration", ramp.duration, {.unit = "s", .above = 0}, "duration of the ramp");
}

void declare_harmonic(Section& s, HarmonicInTime& wave) {
  s.number("frequency", wave.frequency, {.unit = "Hz", .above = 0}, "frequency of the sine");
  s.number("phase_deg", wave.phase_deg, {.unit = "deg"}, "phase angle; 90 gives a cosine");
  s.number("start", wave.start, {.unit = "s"}, "time at which it begins; the factor is 0 before");
}

void declare_table(Section& s, TableInTime& table) {
  s.file("file", table.file, "two columns: time (s) and factor");
  s.numbers("times", table.times, {.unit = "s"}, "instead of a file: times, increasing");
  s.numbers("values", table.values, {}, "instead of a file: factor at each time");
  if (!table.file.empty()) {
    s.rule(table.times.empty() && table.values.empty(), "file",
           "gives the points: remove `times` and `values`, or this key");
    table = read_time_table(table.file);
  }
  bool increasing = table.times.size() == table.values.size();
  for (size_t i = 1; increasing && i < table.times.size(); ++i)
    increasing = table.times[i] > table.times[i - 1];
  s.rule(increasing && !table.times.empty(), "times",
         "must increase, with one entry of values for each time");
}

void declare_constant(Section&, ConstantInTime&) {}

void declare_time_function(Section& s, TimeFunction& time) {
  s.variant<TimeFunction>(
      "type", time,
      {alternative<TimeFunction>("constant", "factor 1 at all times", declare_constant),
       alternative<TimeFunction>("ramp", "linear change from one factor to another", declare_ramp),
       alternative<TimeFunction>("harmonic", "sine wave", declare_harmonic),
       alternative<TimeFunction>("table", "linear interpolation between given points", declare_table)},
      "variation in time");
}

}  // namespace

void declare_region(Section& s, BlockRegion& region, const std::string& blocks) {
  s.blocks("blocks", region.blocks, "numbers or names of " + blocks);
  s.text("member", region.member,
         "only blocks of this member and its copies, wythe or group of bonders; empty: any");
  s.optional_section("sector", region.sector, "only blocks whose centroids lie in this sector",
                     declare_sector);
  s.optional_section("profile", region.profile, "factor that varies with the azimuth of each block",
                     declare_profile);
}

void declare_time(Section& s, const std::string& key, TimeFunction& time, const std::string& meaning) {
  std::optional<TimeFunction> given;
  s.optional_section(key, given, meaning, declare_time_function);
  if (given) time = *given;
}

void declare_ties(Section& s, Ties& ties) {
  s.list("pairs", ties.pairs, "ties between two blocks", declare_pair);
  s.retired("chains", "give geometry.chains, whose links the generator finds by course or height");
  s.number("rod_stiffness", ties.rod_stiffness, {.unit = "N/m", .above = 0},
           "stiffness that replaces the infinite one of imported rigid rods");
}

void declare_restraint(Section& s, Restraint& restraint) {
  s.required_block("block", restraint.block, "number or name of the block");
  s.optional_vector3("point", restraint.point, {.unit = "m"}, "centroid",
                     "held point, in the as-built geometry");
  s.vector3("direction", restraint.direction, {},
            "direction in which it is held, both ways; across it the point moves freely");
  s.rule(restraint.direction.norm() > 0.0, "direction", "must not be zero");
  s.number("stiffness", restraint.stiffness, {.unit = "N/m", .above = 0}, "of the restraint");
}

void declare_supports(Section& s, Supports& supports) {
  s.optional_section(
      "base_motion", supports.base_motion,
      "ground motion, followed by all fixed blocks; displacements and speeds are relative to it",
      declare_base_motion);
  s.list("moves", supports.moves, "displacements imposed on fixed blocks", declare_move);
  s.list("restraints", supports.restraints,
         "points held in one direction, without friction: rollers and props", declare_restraint);
}

}  // namespace cupola
