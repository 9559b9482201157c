#include "assembly/case/declare.hpp"
#include "assembly/files/time_table.hpp"

namespace cupola {
namespace {

void declare_pair(Section& s, PairTie& tie) {
  s.required_integer("block_a", tie.block_a, {.min = 0}, "one end");
  s.required_integer("block_b", tie.block_b, {.min = 0}, "other end");
  s.optional_vector3("point_a", tie.point_a, {.unit = "m"}, "centroid", "anchor on block_a, as built");
  s.optional_vector3("point_b", tie.point_b, {.unit = "m"}, "centroid", "anchor on block_b, as built");
  s.number("stiffness", tie.stiffness, {.unit = "N/m", .above = 0}, "force per stretch");
  s.number("prestress", tie.prestress, {.unit = "N", .min = 0}, "force as built");
}

void declare_chain(Section& s, ChainTie& chain) {
  s.required_integer("ring", chain.ring, {.min = 0}, "ring whose blocks it links");
  s.number("stiffness", chain.stiffness, {.unit = "N/m", .above = 0}, "force per stretch of each link");
  s.number("prestress", chain.prestress, {.unit = "N", .min = 0}, "force as built");
}

void declare_base_motion(Section& s, BaseMotion& motion) {
  s.file("file", motion.file, "two columns: time (s) and value (m or m/s2)");
  s.choice("quantity", motion.quantity, "what the file holds");
  s.vector3("direction", motion.direction, {}, "displacement per unit of the file");
  s.rule(!motion.file.empty(), "file", "must be given");
}

void declare_move(Section& s, SupportMove& move) {
  s.integers("blocks", move.blocks, {.min = 0}, "fixed blocks that move; none named: all");
  s.vector3("displacement", move.displacement, {.unit = "m"}, "how far");
  s.vector3("rotation_deg", move.rotation_deg, {.unit = "deg"}, "rotation vector");
  s.vector3("pivot", move.pivot, {.unit = "m"}, "point that the rotation leaves in place");
  declare_time(s, "time", move.time, "factor on displacement and rotation");
}

void declare_ramp(Section& s, RampInTime& ramp) {
  s.number("from", ramp.from, {}, "factor before");
  s.number("to", ramp.to, {}, "factor after");
  s.number("start", ramp.start, {.unit = "s"}, "when it begins to change");
  s.number("duration", ramp.duration, {.unit = "s", .above = 0}, "how long it changes");
}

void declare_harmonic(Section& s, HarmonicInTime& wave) {
  s.number("frequency", wave.frequency, {.unit = "Hz", .above = 0}, "of the sine");
  s.number("phase_deg", wave.phase_deg, {.unit = "deg"}, "90 makes it a cosine");
}

void declare_table(Section& s, TableInTime& table) {
  s.file("file", table.file, "two columns: time (s) and factor");
  s.numbers("times", table.times, {.unit = "s"}, "instead of a file: increasing times");
  s.numbers("values", table.values, {}, "and the factors at them");
  if (!table.file.empty()) table = read_time_table(table.file);
  bool increasing = table.times.size() == table.values.size();
  for (size_t i = 1; increasing && i < table.times.size(); ++i)
    increasing = table.times[i] > table.times[i - 1];
  s.rule(increasing && !table.times.empty(), "times", "must increase, with as many values");
}

void declare_constant(Section&, ConstantInTime&) {}

void declare_time_function(Section& s, TimeFunction& time) {
  s.variant<TimeFunction>("type", time,
                          {alternative<TimeFunction>("constant", "always 1", declare_constant),
                           alternative<TimeFunction>("ramp", "from one factor to another", declare_ramp),
                           alternative<TimeFunction>("harmonic", "sine", declare_harmonic),
                           alternative<TimeFunction>("table", "linear between points", declare_table)},
                          "how it varies");
}

}  // namespace

void declare_time(Section& s, const std::string& key, TimeFunction& time, const std::string& meaning) {
  std::optional<TimeFunction> given;
  s.optional_section(key, given, meaning, declare_time_function);
  if (given) time = *given;
}

void declare_ties(Section& s, Ties& ties) {
  s.list("pairs", ties.pairs, "ties between two blocks", declare_pair);
  s.list("chains", ties.chains, "closed chains around a dome", declare_chain);
  s.number("rod_stiffness", ties.rod_stiffness, {.unit = "N/m", .above = 0},
           "stands for the infinite one of imported rigid rods");
}

void declare_supports(Section& s, Supports& supports) {
  s.optional_section("base_motion", supports.base_motion, "all fixed blocks move as the ground does",
                     declare_base_motion);
  s.list("moves", supports.moves, "displacements imposed on fixed blocks", declare_move);
}

}  // namespace cupola
