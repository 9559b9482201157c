#pragma once

#include "assembly/model/assembly.hpp"
#include "assembly/records/record.hpp"

namespace cupola {

// Rows of the arrays of assembly.vtu.

template <class Visitor>
void fields(Visitor&& visit, Is<Part> auto& p) {
  visit("block", "", "block to which the part belongs; parts are sorted by block", p.block);
  visit("ring", "", "course of the part; -1 for a support", p.ring);
  visit("slice", "", "azimuthal (or horizontal) slice of the grid", p.slice);
  visit("volume", "m3", "of the part", p.volume);
  visit("face_start", "", "first of its faces in the face arrays below", p.face_start);
  visit("num_faces", "", "number of its faces", p.num_faces);
}

template <class Visitor>
void fields(Visitor&& visit, Is<Block> auto& b) {
  visit("block_kind", "", "0 standard, 1 herringbone, 2 support, 3 imported", b.kind);
  visit("block_fixed", "", "1: the block is fixed and has no unknowns", b.fixed);
  visit("block_ring", "", "first ring that it occupies; -1 for a support", b.ring);
  visit("block_num_rings", "", "number of rings that it spans", b.num_rings);
  visit("block_slot", "",
        "place in its first ring, counted along the azimuth: masonry is laid counter-clockwise", b.slot);
  visit("block_sail", "", "sail in which its centroid lies; 0 for surfaces without sails", b.sail);
  visit("block_sail_position", "", "across the sail, from -1 to 1, 0 at mid-sail", b.sail_position);
  visit("block_spiral", "", "herringbone spiral, of a crossing pair those of right hand first; -1 for none",
        b.spiral);
  visit("block_density", "kg/m3", "mass over volume", b.density);
  visit("block_volume", "m3", "of its parts together", b.volume);
  visit("block_mass", "kg", "volume times density", b.mass);
  visit("block_centroid", "m", "world axes (3)", b.centroid);
  visit("block_inertia", "kg m2", "about the centroid, world axes (9, symmetric matrix)", b.inertia);
}

/// In the order of the content hash.
template <class Visitor>
void fields(Visitor&& visit, Is<BuiltTie> auto& t) {
  visit("tie_block_a", "", "block at its first end", t.block_a);
  visit("tie_block_b", "", "block at its second end", t.block_b);
  visit("tie_stiffness", "N/m", "infinity for a rigid rod", t.stiffness);
  visit("tie_length", "m", "natural length (no force)", t.length);
  visit("tie_pushes", "", "1: also carries compression", t.pushes);
  visit("tie_yield_force", "N", "tension at which it elongates plastically; infinity: elastic without limit",
        t.yield_force);
  visit("tie_chain", "", "chain of which it is a bar; -1: none. The bars of a chain follow each other",
        t.chain);
  visit("tie_point_a", "m", "first anchor in the as-built geometry (3)", t.point_a);
  visit("tie_point_b", "m", "second anchor (3)", t.point_b);
}

template <class Visitor>
void fields(Visitor&& visit, Is<BuiltChain> auto& c) {
  visit("chain_name", "", "name of the chain", c.name);
  visit("chain_height", "m", "mean height of the ends of its bars", c.height);
}

template <class Visitor>
void fields(Visitor&& visit, Is<Sheet> auto& s) {
  visit("sheet_name", "", "of the member; `shell` if it has none", s.name);
  visit("sheet_first_ring", "", "first of its courses; those of the next sheet follow", s.first_ring);
  visit("sheet_num_rings", "", "number of its courses", s.num_rings);
  visit("sheet_closed", "", "1: the last block of a course meets the first", s.closed);
  visit(
      "sheet_thrust_lines", "",
      "where thrust lines are drawn, and what is outwards: 0 nowhere (a wall), 1 in its x-z plane (an arch), "
      "2 at any azimuth about its axis, 3 nowhere, but outwards is away from its axis",
      s.thrust_lines);
  visit("sheet_sails", "", "equal parts about its axis", s.sails);
  visit("sheet_on_previous", "", "1: its first bed lies on the last bed of the sheet before", s.on_previous);
  visit("sheet_origin", "m", "a point of its vertical axis (3)", s.origin);
  visit("sheet_turn", "rad", "about that axis, from the x axis of the world to its own", s.turn);
}

}  // namespace cupola
