#pragma once

#include <string>

#include "solver/collision/patch_contacts.hpp"

namespace cupola {

/// Contact points from elsewhere, for people whose CAD knows better: a CSV file with the header
///
///     block_a,block_b,joint,x,y,z,nx,ny,nz,gap_m,area_m2
///
/// and one row per point, in the configuration of the assembly: the two blocks, a number that is the same for
/// the points of one joint, the point (m), the direction from block_a to block_b (any length), the gap
/// (positive when apart) and the area that the point stands for. Points of a joint are kept in their order.
/// A joint between rings is a bed, within a ring a head, with a fixed block the base.
///
/// Throws InputError with file and line for what is missing, not a number, or names no pair of blocks.
AnchoredContacts read_contacts(const std::string& path, const Assembly& assembly);

}  // namespace cupola
