#include "assembly/model/loads_on_top.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/loaded_faces.hpp"

namespace cupola {
namespace {

/// The kind of member on which a load stands.
struct Bearer {
  const char* name;
  bool (*is)(const Sheet&);
};
constexpr Bearer kDome{"dome", [](const Sheet& sheet) { return sheet.closed; }};
constexpr Bearer kWall{"wall",
                       [](const Sheet& sheet) { return sheet.thrust_lines == Sheet::ThrustLines::none; }};

/// "loads.forces: [{block: 6, force: [0, 0, -1e+04]}]": a weight on the highest block.
std::string force_on_highest(const Assembly& assembly, double weight) {
  const auto highest = std::ranges::max_element(assembly.blocks, {}, [](const Block& b) {
    return b.fixed ? -std::numeric_limits<double>::infinity() : b.centroid.z();
  });
  return fmt::format("loads.forces: [{{block: {}, force: [0, 0, {:.6g}]}}]",
                     highest - assembly.blocks.begin(), -weight);
}

[[noreturn]] void refuse_without_tops(const Assembly& assembly, double weight, const char* key) {
  if (weight == 0.0)
    throw InputError(fmt::format(
        "loads.{}: the assembly has no faces of kind top to carry it, and no force stands for a mass without "
        "gravity",
        key));
  throw InputError(
      fmt::format("loads.{}: the assembly has no faces of kind top to carry it; give it to the highest block "
                  "as {}",
                  key, force_on_highest(assembly, weight)));
}

/// Copies of a member share a load evenly. Which of others was meant, no key says.
void require_equal_tops(const Assembly& assembly, const std::vector<LoadedFace>& tops, const char* key) {
  constexpr double kEqual = 0.01;  // relative: above what imperfections change
  std::map<const Sheet*, double> areas;
  for (const LoadedFace& face : tops) areas[assembly.sheet_of(assembly.parts[face.part].ring)] += face.area;
  const auto [least, greatest] =
      std::ranges::minmax_element(areas, {}, [](const auto& of_sheet) { return of_sheet.second; });
  if (greatest->second - least->second > kEqual * greatest->second)
    throw InputError(
        fmt::format("loads.{}: stands on one dome, but faces of kind top are on {} and {}; give it to one as "
                    "loads.faces: [{{kind: top, member: NAME, traction: [0, 0, -p]}}], p in N/m2",
                    key, least->first->name, greatest->first->name));
}

/// The tops of all members, or those of one kind if there are others.
std::vector<LoadedFace> tops_of(const Bearer& bearer, const Assembly& assembly, const char* key) {
  std::vector<LoadedFace> tops = faces_of_kind(assembly, std::array{FaceKind::top}, 0, kLastRing, "");
  if (assembly.sheets.size() < 2 || std::ranges::none_of(assembly.sheets, bearer.is)) return tops;
  std::erase_if(tops, [&](const LoadedFace& face) {
    const Sheet* sheet = assembly.sheet_of(assembly.parts[face.part].ring);
    return !sheet || !bearer.is(*sheet);
  });
  if (tops.empty())
    throw InputError(
        fmt::format("loads.{}: no {} has faces of kind top to carry it; give it to the blocks that do as "
                    "loads.forces: [{{block: NUMBER, force: [0, 0, -N]}}]",
                    key, bearer.name));
  if (bearer.is == kDome.is) require_equal_tops(assembly, tops, key);
  return tops;
}

}  // namespace

void require_top_for_lantern(const Assembly& assembly, double gravity) {
  if (!faces_of_kind(assembly, std::array{FaceKind::top}, 0, kLastRing, "").empty()) return;
  throw InputError(fmt::format(
      "analysis.limit.parameter: lantern requires faces of kind top to carry it, and the assembly "
      "has none; write {} and limit.parameter: load, whose factor is then that on the weight of "
      "the blocks",
      force_on_highest(assembly, free_weight(assembly, gravity))));
}

void add_loads_on_top(const Loads& loads, const Assembly& assembly, std::vector<PointForce>* forces) {
  const double g = loads.gravity.norm(), of_blocks = free_weight(assembly, g);
  const Vec3 down = g > 0.0 ? Vec3(loads.gravity / g) : Vec3(-Vec3::UnitZ());
  const auto add = [&](const std::optional<TopLoad>& load, const Bearer& bearer, const char* key) {
    if (!load) return;
    const double weight = load->total(of_blocks, g);  // negative in the derivative of a limit analysis
    const double mass = g > 0.0 ? weight / g : load->mass;
    if (weight == 0.0 && mass == 0.0) return;
    const std::vector<LoadedFace> tops = tops_of(bearer, assembly, key);
    if (tops.empty()) refuse_without_tops(assembly, weight, key);
    double total_area = 0.0;
    for (const LoadedFace& face : tops) total_area += face.area;
    for (const LoadedFace& face : tops) {
      PointForce force{face.block, face.centroid, weight * face.area / total_area * down};
      force.mass = mass * face.area / total_area;
      forces->push_back(force);
      if (!loads.pull.isZero(0.0))
        forces->push_back({face.block, face.centroid, force.mass * loads.pull, PointForce::kSteady});
    }
  };
  add(loads.lantern, kDome, "lantern");
  add(loads.top_load, kWall, "top_load");
}

}  // namespace cupola
