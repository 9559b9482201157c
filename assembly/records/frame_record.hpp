#pragma once

#include "assembly/model/results.hpp"
#include "assembly/records/record.hpp"

namespace cupola {

// Each member is a column of a table of a frame. The places of its rows are the points of the mesh.

template <class Visitor>
void fields(Visitor&& visit, Is<ContactTable> auto& c) {
  visit("joint", "", "contacts with the same number form one joint; valid within the frame", c.joint);
  visit("block_a", "", "first of the two blocks, a < b", c.block_a);
  visit("block_b", "", "second block", c.block_b);
  visit("kind", "", "0 bed (between rings), 1 head (within a ring), 2 base (at a support), 3 other, 4 wythe",
        c.kind);
  visit("ring", "", "course of the upper part, at a support that of the other block", c.ring);
  visit("normal", "", "unit normal from a to b (3)", c.normal);
  visit("gap_m", "m", "positive when apart", c.gap);
  visit("force_N", "N", "contact force on b (3)", c.force);
  visit("normal_force_N", "N", "component along the normal; >= 0 without tensile strength", c.normal_force);
  visit("friction_use", "",
        "tangential force over cohesion times area + mu times normal force; 0 without force", c.friction_use);
  visit(
      "area_m2", "m2",
      "tributary area of the point, without what opens beyond `contact.margin`; 0 on an edge or at a corner",
      c.area);
  visit("slip_m", "m", "accumulated sliding; `nan`: the faces have parted by more than `contact.margin`",
        c.slip);
  visit("law_violation", "",
        "distance of the force from the one that the contact law gives, over the force of the joint, or over "
        "1 % of the mean joint force if that is larger; `nan` where both blocks sleep",
        c.law_violation);
}

/// Of contacts where some joint has strength; empty otherwise.
template <class Visitor>
void strength_fields(Visitor&& visit, Is<ContactTable> auto& c) {
  visit("friction_limit_N", "N", "largest tangential force: cohesion left times area + mu times normal force",
        c.friction_limit);
  visit(
      "strength_use", "",
      "pressure over the compressive strength, or pull over the tensile strength that is left; `nan` if dry",
      c.strength_use);
  visit("damage", "", "share of tension and cohesion that is lost, 0 to 1; `nan` without either", c.damage);
  visit("crack_opening_m", "m",
        "distance of the faces beyond the elastic elongation of the joint; 0 where closed", c.crack_opening);
}

template <class Visitor>
void fields(Visitor&& visit, Is<BlockTable> auto& b) {
  visit("quaternion_wxyz", "", "rotation from the orientation in the assembly (4)", b.quaternion_wxyz);
  visit("velocity_m_per_s", "m/s", "of the centroid, relative to the ground (3)", b.velocity);
  visit("angular_velocity_rad_per_s", "rad/s", "about world axes (3)", b.angular_velocity);
  visit("displacement_m", "m", "of the centroid since the assembly, relative to the ground (3)",
        b.displacement);
}

/// Of blocks on a path and in a motion; empty otherwise.
template <class Visitor>
void contact_pose_fields(Visitor&& visit, Is<BlockTable> auto& b) {
  visit("contact_position_m", "m", "of the centroid where the contacts were found (3)", b.contact_position);
  visit("contact_quaternion_wxyz", "", "rotation there (4)", b.contact_quaternion_wxyz);
}

template <class Visitor>
void fields(Visitor&& visit, Is<TieTable> auto& t) {
  visit("chain", "", "chain of which it is a bar; -1: none", t.chain);
  visit("block_a", "", "first of the two blocks, a < b; of a restraint the first fixed block", t.block_a);
  visit("block_b", "", "second block", t.block_b);
  visit("force_N", "N", "tension; of a strut thrust", t.force);
  visit("yield_force_N", "N", "tension at which it elongates plastically; infinity: elastic without limit",
        t.yield_force);
  visit("yielded_m", "m", "plastic elongation", t.yielded);
  visit("strut", "", "1: resists shortening; a rod is a tie and a strut", t.strut);
}

}  // namespace cupola
