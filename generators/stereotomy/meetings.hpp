#pragma once

#include <span>
#include <vector>

#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/cut_bodies.hpp"
#include "generators/stereotomy/shell.hpp"

namespace cupola {

/// Gives the mitres of copies the copy of the same number of the member that they name, if that has copies.
/// Throws InputError if there is none of this number, and for copies of one member.
void pair_mitres(std::vector<Storey>* storeys);

/// Gives the faces of mitres their kind. `starts`: of the blocks and parts of each storey, and the end of the
/// last. Throws InputError for a mitre on which no stone of one member meets one of the other, and for a
/// member beside another that does not reach it: no face of its stones and supports shares a patch with one
/// of the other in their common plane.
void check_meetings(std::span<const Storey> storeys, std::span<const MemberStart> starts, Assembly* assembly);

}  // namespace cupola
