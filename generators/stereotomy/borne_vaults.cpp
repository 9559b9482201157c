#include "generators/stereotomy/borne_vaults.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace cupola {
namespace {

bool has_outward(const Sheet& sheet) {
  return sheet.thrust_lines != Sheet::ThrustLines::none;
}

/// Of the sheets reached from a wall the next vault in the list, else the nearest before it; -1 without one.
int vault_among(const std::set<int>& reached, int wall, const std::vector<Sheet>& sheets) {
  const auto is_vault = [&](int i) { return has_outward(sheets[i]); };
  const auto own = reached.find(wall);
  const auto next = std::find_if(own, reached.end(), is_vault);
  if (next != reached.end()) return *next;
  const auto before = std::find_if(std::make_reverse_iterator(own), reached.rend(), is_vault);
  return before == reached.rend() ? -1 : *before;
}

/// Adds the sheets that have joints with those reached; false if there is none.
bool reach_next(const std::set<std::pair<int, int>>& joined, std::set<int>* reached) {
  const std::set<int> before = *reached;
  for (const auto& [a, b] : joined) {
    if (before.contains(a)) reached->insert(b);
    if (before.contains(b)) reached->insert(a);
  }
  return reached->size() > before.size();
}

}  // namespace

void find_borne_vaults(const std::set<std::pair<int, int>>& joined, Assembly* assembly) {
  std::vector<Sheet>& sheets = assembly->sheets;
  if (std::ranges::count_if(sheets, has_outward) < 2) return;  // all push along the one
  for (int wall = 0; wall < static_cast<int>(sheets.size()); ++wall) {
    if (has_outward(sheets[wall])) continue;
    std::set<int> reached;
    for (int i = 0; i < static_cast<int>(sheets.size()); ++i)
      if (assembly->stack_of(sheets[i].first_ring) == assembly->stack_of(sheets[wall].first_ring))
        reached.insert(i);
    do sheets[wall].vault = vault_among(reached, wall, sheets);
    while (sheets[wall].vault < 0 && reach_next(joined, &reached));
  }
}

}  // namespace cupola
