#pragma once

#include <string>
#include <vector>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/piece_courses.hpp"

namespace cupola {

/// Where the blocks of one member begin in an assembly; those of the members before stay as they are.
struct MemberStart {
  size_t block = 0, part = 0;
};

/// A cut and its bodies, n.x <= offset for all planes of one, in the coordinates of its member; its key for
/// messages.
struct CutBody {
  Cut cut;
  std::vector<std::vector<Plane>> bodies;
  std::string key;
  bool from_supports = false;  ///< only from these, of which it may take nothing
};

/// Takes the bodies of the cuts from the blocks of the last member, supports included.
///
/// A part less a convex body is at most one convex piece per plane of the body. The pieces of a block that
/// still touch each other stay one block, others become blocks of their own. A block of less than a tenth of
/// what was cut joins the block of its course, or else of a neighbouring one, with which it shares the widest
/// face, across a gap of up to `gap` (m). Behind the faces of a cut `as: held` stands a fixed block,
/// `support_width` (m) deep; a plane `as: joint` takes nothing and parts the blocks that it meets. What is
/// left of a support on which no stone stands, across such a gap, is dropped. Courses of blocks and parts are
/// those that are left of them.
///
/// Throws InputError that begins with the key of a cut that takes or parts nothing, or takes all blocks.
void cut_bodies(const std::vector<CutBody>& bodies, const MemberStart& start, double support_width,
                double density, double gap, BedUnder bed_under, Assembly* assembly);

}  // namespace cupola
