#pragma once

#include <set>
#include <utility>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Sets Sheet::vault of the walls and piers of several vaults. `joined`: pairs of sheets with joints.
void find_borne_vaults(const std::set<std::pair<int, int>>& joined, Assembly* assembly);

}  // namespace cupola
