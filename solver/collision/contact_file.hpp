#pragma once

#include <string>

#include "solver/collision/patch_contacts.hpp"

namespace cupola {

/// Reads contact points computed by another program from a CSV file with the header
///
///     block_a,block_b,joint,x,y,z,nx,ny,nz,gap_m,area_m2
///
/// and one row per point, in the configuration of the assembly:
///
///     block_a, block_b   indices of two different blocks
///     joint              the same integer for all points of one joint
///     x, y, z            the point, m
///     nx, ny, nz         direction from block_a to block_b, of any length
///     gap_m              m, positive when apart
///     area_m2            tributary area of the point, m2
///
/// Points of a joint keep their order. A joint between two rings is a bed, one within a ring is a head, and
/// one with a fixed block is a base joint.
///
/// Throws InputError with file and line for missing columns, invalid numbers, invalid block pairs, and points
/// with a gap beyond `margin` (m, that of the case, see joint_rule()) or farther from a block than a tenth of
/// its size.
AnchoredContacts read_contacts(const std::string& path, const Assembly& assembly, double margin = 0.0);

}  // namespace cupola
