#pragma once

#include "assembly/model/results.hpp"
#include "assembly/records/record.hpp"

namespace cupola {

template <class Visitor>
void fields(Visitor&& visit, Is<Accuracy> auto& a) {
  visit("quantity", "", "what is in error", a.quantity);
  visit("norm", "", "in which norm", a.norm);
  visit("asked", "", "error requested", a.asked);
  visit("reached", "", "error in the state shown; null if it was not measured", a.reached);
  visit("worst_over_run", "", "largest of all steps or stages", a.worst_over_run);
}

template <class Visitor>
void fields(Visitor&& visit, Is<ForceCertificate> auto& c) {
  visit("value", "", "upper bound of the error", c.value);
  visit(c.value ? "bounds" : "not_certified", "",
        "what it bounds in which norm; `not_certified`: why there is none", c.bounds);
}

template <class Visitor>
void fields(Visitor&& visit, Is<ForcesUnique> auto& u) {
  visit("value", "", "whether the model determines its forces uniquely", u.value);
  visit("reason", "", "why", u.reason);
}

template <class Visitor>
void fields(Visitor&& visit, Is<LawViolation> auto& v) {
  visit("value", "", "`law_violation` of the contact", v.value);
  visit("joint", "", "its joint in the frame at that time", v.joint);
  visit("block_a", "", "first of its blocks", v.block_a);
  visit("block_b", "", "second of its blocks", v.block_b);
  visit("time_s", "s", "when", v.time);
}

template <class Visitor>
void fields(Visitor&& visit, Is<RunStep> auto& s) {
  visit("step", "", "its number, from 1", s.step);
  visit("time_s", "s", "at its end", s.time);
}

template <class Visitor>
void fields(Visitor&& visit, Is<WorstSteps> auto& w) {
  visit("momentum_residual", "", "where it was largest", w.momentum_residual);
  visit("contact_law_residual", "", "where it was largest", w.contact_law_residual);
  visit("certified_force_error", "", "where it was largest", w.certified_force_error);
}

template <class Visitor>
void fields(Visitor&& visit, Is<Robustness> auto& r) {
  visit("directions", "", "number of directions decided", r.directions);
  visit("acceleration_g", "g", "least horizontal acceleration with an admissible state; 0: any push moves it",
        r.acceleration_g);
  visit("moving_g", "g", "the same with a mechanism", r.moving_g);
  visit("azimuth_deg", "degrees", "its direction, from x towards y", r.azimuth_deg);
}

template <class Visitor>
void fields(Visitor&& visit, Is<Sought> auto& s) {
  visit("quantity", "", "what was sought, as `critical friction`", s.quantity);
  visit(
      "found", "",
      "where there is no value: `no limit above 0.15`, `none`, `not found`, `unknown`, `0`; empty: there is "
      "one",
      s.found);
  visit("reason", "", "what shows that", s.reason);
  visit("advice", "", "what to try; may be empty", s.advice);
  visit("also", "", "what else is known, as a second limit; may be empty", s.also);
}

template <class Visitor>
void fields(Visitor&& visit, Is<RangeEnd> auto& e) {
  visit("outcome", "",
        "`bounded`, `unbounded` (by a self-stress without load, or a ratio's denominator of zero), "
        "`undefined` (a ratio to nothing), "
        "`unconverged`",
        e.outcome);
  visit("value", "", "attained by the state found", e.value);
  visit("bound", "", "nothing lies beyond, with forces of up to 1000 times the largest of that state",
        e.bound);
  visit("frame", "", "shows that state, or the self-stress of an unbounded end", e.frame);
}

template <class Visitor>
void fields(Visitor&& visit, Is<ForceRange> auto& r) {
  visit("quantity", "", "what was asked for", r.quantity);
  visit("unit", "", "`N`, `m` or nothing", r.unit);
  visit("min", "", "least value", r.min);
  visit("max", "", "greatest value", r.max);
  visit("joint", "", "of the normal force of a joint: its two blocks", r.joint);
  visit("chosen", "", "value in the state that the compliances choose; absent without one", r.chosen);
}

template <class Visitor>
void fields(Visitor&& visit, Is<PartVerdict> auto& p) {
  visit("first_block", "", "its block of the lowest number", p.first_block);
  visit("blocks", "", "number of its free blocks", p.blocks);
  visit("status", "", "of the part alone", p.status);
}

template <class Visitor>
void fields(Visitor&& visit, Is<Interruption> auto& i) {
  visit("program_version", "", "version of the program", i.program_version);
  visit("case_hash", "", "hash of the case", i.case_hash);
  visit("assembly_hash", "", "hash of the assembly", i.assembly_hash);
  visit("resumable", "", "whether there is a checkpoint", i.resumable);
  visit("frames", "", "number of frames written", i.frames);
  visit("last_line", "", "of the log: the last step, trial or iteration", i.last_line);
  visit("wall_time_seconds", "s", "elapsed time", i.wall_time_seconds);
}

/// The critical value of a limit analysis is beside these, as three keys.
template <class Visitor>
void fields(Visitor&& visit, Is<Summary> auto& s) {
  visit("status", "", "see the table below", s.status);
  visit("message", "", "the reason for the status, with the numbers", s.message);
  visit("forces_unique", "", "whether the model determines its forces uniquely, see below", s.forces_unique);
  visit("analysis", "", "type of analysis, as in the case", s.analysis);
  visit("method", "", "contact method, as in the case", s.method);
  visit("friction_law", "", "as in the case; `dilatant` where its `dilatancy` lies between 0 and 1",
        s.friction_law);
  visit("dilatancy", "", "ratio of dilatancy to friction, if the case gives it", s.dilatancy);
  visit("tangential", "", "tangential spring, as in the case", s.tangential);
  visit("program_version", "", "version of the program", s.program_version);
  visit("case_hash", "", "hash of the case", s.case_hash);
  visit("geometry_hash", "", "hash of what the generator read of the case", s.geometry_hash);
  visit("assembly_hash", "", "hash of the assembly", s.assembly_hash);
  visit("blocks", "", "all blocks", s.blocks);
  visit("free_blocks", "", "blocks that are not fixed", s.free_blocks);
  visit("joints", "", "number of joints", s.joints);
  visit("contacts", "", "number of contact points", s.contacts);
  visit("unknowns", "", "six per free block, three in a plane model", s.unknowns);
  visit("weight_N", "N", "total weight of the free blocks", s.weight_N);
  visit("applied_load_N", "N",
        "resultant of all loads on the free blocks, weight included; in motions at the middle of the last "
        "step, as in its balance (3)",
        s.applied_load_N);
  visit("support_reaction_N", "N", "resultant of the forces of the fixed blocks on the free ones (3)",
        s.support_reaction_N);
  visit("time_step_s", "s", "time step h; in statics, of the step that gives the answer", s.time_step_s);
  visit("accuracy", "",
        "the error that decides whether the status is `unconverged` or `bracketed`, see below", s.accuracy);
  visit("momentum_residual", "", "largest unbalanced impulse of a block, over the mean block weight times h",
        s.momentum_residual);
  visit("equilibrium_residual", "",
        "largest unbalanced force of a free block, inertia included, over the mean block weight; "
        "moments over weight times block size",
        s.equilibrium_residual);
  visit("inertia_share", "", "statics: 1 - reaction / load, along the load", s.inertia_share);
  visit("energy_error", "",
        "motions: largest error of the account of energy in `history.csv`, over the larger of what was "
        "dissipated and the largest kinetic energy",
        s.energy_error);
  visit("contact_law_residual", "", "error of all impulses in the contact law, over their norm",
        s.contact_law_residual);
  visit("largest_law_violation", "", "the largest `law_violation` of a contact, see below",
        s.largest_law_violation);
  visit("certified_force_error", "", "upper bound of the error of the forces, see below",
        s.certified_force_error);
  visit("worst_steps", "", "motions: the steps where the residuals were largest, see below", s.worst_steps);
  visit(
      "friction_cone_violation", "",
      "largest excess of tangential force over mu times normal force (or largest tension), over the largest "
      "normal force",
      s.friction_cone_violation);
  visit("max_penetration_m", "m", "largest overlap at a contact", s.max_penetration_m);
  visit("max_displacement_m", "m",
        "of a block relative to the ground; in motions of the farthest point of a free one at any step, "
        "without "
        "what it follows of the move of a support; not in limit analyses, nor in statics without an "
        "equilibrium",
        s.max_displacement_m);
  visit("max_displacement_time_s", "s", "motions: when a block was displaced by that",
        s.max_displacement_time_s);
  visit("final_displacement_m", "m", "motions: the largest of a free block at the end",
        s.final_displacement_m);
  visit("max_speed_m_per_s", "m/s", "motions: of the fastest point relative to the ground at the end",
        s.max_speed_m_per_s);
  visit("rest_at_end", "", "motions: whether it is at rest at the end, as `stable` demands", s.rest_at_end);
  visit("slipping_contacts", "", "number of loaded contacts on their friction cone", s.slipping_contacts);
  visit("steps", "", "number of steps", s.steps);
  visit("iterations", "", "of the contact method, in total", s.iterations);
  visit("solve_time_seconds", "s", "elapsed time of the contact solves only", s.solve_time_seconds);
  visit("wall_time_seconds", "s", "elapsed time of the whole program", s.wall_time_seconds);
  visit("cpu_time_seconds", "s", "processor time of the whole program", s.cpu_time_seconds);
  visit("peak_memory_bytes", "bytes", "largest memory used", s.peak_memory_bytes);
  visit("threads", "", "number of threads", s.threads);
  visit("robustness", "", "static analysis with `analysis.robustness`, see below", s.robustness);
  visit("warnings", "", "doubts about the case and the blocks, one sentence each", s.warnings);
  visit("bears_loads_until_s", "s",
        "a path by a `length` that ends before the loads of the case are reached: the latest of its times",
        s.bears_loads_until_s);
  visit(
      "stands_at_both_ends", "",
      "limit analysis without a critical value: whether the structure stands, or moves, at both ends of its "
      "bracket; absent if it stands only between them",
      s.stands_at_both_ends);
  visit("sought", "",
        "limit analysis, `analysis.robustness` and `analysis.staged.least`: what the search found, see below",
        s.sought);
  visit("ranges", "", "range analysis only: one entry per quantity, see below", s.ranges);
  visit("parts", "",
        "static analysis without an equilibrium of the whole, of several parts that no contact or tie "
        "connects, see "
        "below",
        s.parts);
  visit("text_files", "", "`run.yaml` and the `.csv` files of this run: name to XXH3-128 hash of the bytes",
        s.text_files);
}

}  // namespace cupola
