#pragma once

#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/cut_blocks.hpp"
#include "generators/stereotomy/cut_bodies.hpp"

namespace cupola {

/// Makes a groin vault of one web: the blocks of the last member, a barrel from the axis to the side y =
/// apothem of a regular n-gon. The vertical planes through the axis and the ends of that side cut the web; n
/// turned copies of it form the vault.
///
/// Stones of two webs that meet at a groin become one block where the groins are bonded: in each course and
/// wythe the two with the largest faces on the groin, if neither is joined across this groin already. Stones
/// that touch two groins so become one key stone. Courses are counted from the supports to the crown. The
/// supports are prisms behind the first and last beds of the webs, one block per corner, cut by the planes of
/// the groins. Springers are one stone per corner instead of the lowest courses, on a level bed under which
/// the supports lie, or another member.
void cross_webs(const Storey& shell, const MemberStart& start, const CutOptions& options, Assembly* assembly);

}  // namespace cupola
