#pragma once

#include <string>
#include <vector>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// Where the blocks of one member begin in an assembly; those of the members before stay as they are.
struct MemberStart {
  size_t block = 0, part = 0;
};

/// Takes the bodies of the cuts from the blocks of the last member, supports included.
///
/// A part less a convex body is at most one convex piece per plane of the body. The pieces of a block that still touch each other
/// stay one block, others become blocks of their own. A block of less than a tenth of what was cut joins the block of its course,
/// or else of a neighbouring one, with which it shares the widest face. Behind the faces of a cut `as: held` stands a fixed block, `support_width` (m) deep.
///
/// Throws InputError that begins with `key`, as geometry.cuts, if a cut takes nothing, or all blocks.
void cut_bodies(const std::vector<Cut>& cuts, const MemberStart& start, double support_width, double density,
                const std::string& key, Assembly* assembly);

}  // namespace cupola
