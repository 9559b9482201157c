#include "postproc/evaluation/rib_ratio.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace cupola {
namespace {

/// Sum of r over the meridians at the same place in every sail, by bed.
std::map<int, double> summed_resultants(const ThrustInput& input, double azimuth_deg, const Sheet& sheet) {
  std::map<int, double> sums;
  for (int sail = 0; sail < sheet.sails; ++sail)
    for (const ThrustPoint& p :
         thrust_line(input, "", azimuth_deg + 360.0 * sail / sheet.sails, std::nullopt, sheet.first_ring)
             .points)
      sums[p.bed] += p.r;
  return sums;
}

}  // namespace

int bond_period(const Bond& bond) {
  if (const auto* b = std::get_if<HerringboneBond>(&bond); b && b->path == HerringboneBond::Path::spiral) {
    const int steps = b->blocks_per_ring * b->verticals_per_block;  // rings of a full turn
    return b->refine * steps / std::gcd(steps, b->spirals);
  }
  return std::holds_alternative<RunningBond>(bond) ? 2 : 1;
}

std::optional<RibRatio> rib_ratio(const ThrustInput& input, const Bond& bond) {
  if (input.assembly->sheets.empty() || input.assembly->sheets.back().sails < 2) return std::nullopt;
  const Sheet& sheet = input.assembly->sheets.back();
  const std::map<int, double> rib = summed_resultants(input, 0.0, sheet);
  const std::map<int, double> mid_sail = summed_resultants(input, 180.0 / sheet.sails, sheet);
  std::vector<double> ratios;
  for (const auto& [bed, r] : rib)
    if (const auto same = mid_sail.find(bed); same != mid_sail.end() && same->second > 0.0)
      ratios.push_back(r / same->second);
  if (ratios.empty()) return std::nullopt;
  const size_t period = static_cast<size_t>(bond_period(bond));
  if (ratios.size() >= period) ratios.resize(ratios.size() / period * period);
  const auto [smallest, largest] = std::minmax_element(ratios.begin(), ratios.end());
  return RibRatio{std::accumulate(ratios.begin(), ratios.end(), 0.0) / static_cast<double>(ratios.size()),
                  *smallest, *largest, sheet.sails, static_cast<int>(ratios.size())};
}

}  // namespace cupola
