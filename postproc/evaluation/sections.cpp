#include "postproc/evaluation/sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "postproc/evaluation/meridians.hpp"
#include "postproc/mechanics/bed_crossing.hpp"
#include "postproc/mechanics/block_pieces.hpp"

namespace cupola {
namespace {

/// m, mean height of a bed, of one that closes a stack that of its facets.
double height_of(const Evaluation& e, int bed) {
  if (!e.shell.closes(bed)) return e.rings[bed].height;
  const std::vector<BedFacet>& facets = e.shell.beds[bed];
  double sum = 0.0;
  for (const BedFacet& f : facets)
    for (const Vec3& corner : {f.intrados_a, f.intrados_b, f.extrados_a, f.extrados_b})
      sum += e.last.poses.placed(f.block, corner).z();
  return sum / static_cast<double>(4 * facets.size());
}

/// The beds of the courses [first, end) that have blocks and a height, of an arch in two flights, from the
/// springing to the crown and from there down to the other one.
std::vector<std::vector<int>> flights_of(const Evaluation& e, int first, int end) {
  std::vector<int> beds;
  for (int k = first; k < end; ++k)
    if (e.rings[k].blocks > 0 && std::isfinite(e.rings[k].height)) beds.push_back(k);
  if (beds.empty() || e.assembly.axis_of(first).thrust_lines != Sheet::ThrustLines::one) return {beds};
  const int closing = e.shell.bed_above(end - 1);
  if (beds.back() + 1 == end && !e.shell.beds[closing].empty()) beds.push_back(closing);
  const auto crown = std::ranges::max_element(beds, {}, [&](int bed) { return height_of(e, bed); });
  return {{beds.begin(), crown + 1}, {crown + 1, beds.end()}};
}

/// True if the courses [first, end) stand at a height. Of what lies on each other there the upper counts.
bool stands_at(const Assembly& placed, int first, int end, double height) {
  const double rounding = 1e-6 * block_size(placed);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Part& part : placed.parts)
    if (part.ring >= first && part.ring < end)
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
        for (const int v : placed.face(f)) {
          low = std::min(low, placed.vertices[v].z());
          high = std::max(high, placed.vertices[v].z());
        }
  return low <= height + rounding && height + rounding < high;
}

/// The bed nearest to a height in each flight of each stack that stands there, and whether its flight goes
/// down.
std::vector<std::pair<int, bool>> nearest_beds(const Evaluation& e, const Assembly& placed, double height) {
  const auto distance = [&](int bed) { return std::abs(height_of(e, bed) - height); };
  std::vector<std::pair<int, bool>> nearest;
  const int num_rings = static_cast<int>(e.rings.size());
  for (int first = 0, end = 0; first < num_rings; first = end) {
    end = std::min(e.assembly.stack_of(first).second, num_rings);
    if (!stands_at(placed, first, end, height)) continue;
    bool downwards = false;
    for (const std::vector<int>& beds : flights_of(e, first, end)) {
      if (beds.empty()) continue;
      nearest.emplace_back(*std::ranges::min_element(beds, {}, distance), std::exchange(downwards, true));
    }
  }
  return nearest;
}

/// Adds the resultants of all blocks that stand on a bed or that the bed runs through. That of a block which
/// is one convex part acts at its foot.
void add_resultants(const Evaluation& e, const ThrustInput& input, int bed, bool downwards,
                    SectionEvaluation* section) {
  for (const auto& [b, onwards] : wrenches_across(input, bed, section->beds)) {
    const Block& block = e.assembly.blocks[b];
    const Wrench wrench = downwards ? -1.0 * onwards : onwards;
    const CentralAxis axis = central_axis(wrench);
    if (!axis.exists) continue;
    const bool at_foot = block.ring < bed && !is_divided(e.assembly, b);
    const Vec3 point =
        axis_in_plane(axis, wrench.force, {Vec3::UnitZ(), height_of(e, at_foot ? block.ring : bed)});
    section->resultants.push_back({b, block.kind, wrench, point, azimuth(e.assembly, b, b, point),
                                   couple_length(wrench, e.last.joints.floor)});
  }
}

}  // namespace

std::vector<SectionEvaluation> evaluate_sections(const Evaluation& e, const Assembly& placed,
                                                 const std::vector<bool>& left_out) {
  const ThrustInput input = thrust_input(e, e.last);
  std::vector<SectionEvaluation> sections;
  std::set<double> heights;
  for (const double height : e.scene.postproc.sections) {
    if (!heights.insert(height).second) continue;
    SectionEvaluation section{height, {}, cut_by_plane(placed, {Vec3::UnitZ(), height}, left_out), {}};
    const std::vector<std::pair<int, bool>> beds = nearest_beds(e, placed, height);
    const bool cuts = std::ranges::any_of(
        section.polygons, [&](const CutPolygon& cut) { return !e.assembly.blocks[cut.block].fixed; });
    if (!cuts && (!left_out.empty() || beds.empty())) continue;  // nothing is there but supports
    for (const auto& [bed, downwards] : beds) section.beds.push_back(bed);
    for (const auto& [bed, downwards] : beds) add_resultants(e, input, bed, downwards, &section);
    sections.push_back(std::move(section));
  }
  return sections;
}

std::string beds_text(const Shell& shell, const SectionEvaluation& section, const std::string& course) {
  if (section.beds.empty()) return "none";
  std::vector<int> numbers;
  for (const int bed : section.beds) numbers.push_back(shell.number_of(bed));
  return fmt::format("{}{} {}", course, numbers.size() == 1 ? "" : "s", fmt::join(numbers, ", "));
}

}  // namespace cupola
