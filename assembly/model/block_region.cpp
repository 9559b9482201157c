#include "assembly/model/block_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/loaded_faces.hpp"

namespace cupola {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

void check_blocks(const BlockRegion& region, const Assembly& assembly, bool fixed, const std::string& key) {
  for (const int block : region.blocks) {
    check_block_exists(assembly, block, key + ".blocks");
    if (assembly.blocks[block].fixed != fixed)
      throw InputError(
          fixed ? fmt::format("{}.blocks: block {} is not fixed; only supports can be moved", key, block)
                : fmt::format("{}.blocks: block {} is fixed; `ground: true` heats the supports", key, block));
  }
}

/// The sheet of a member, or of the next that has blocks; null without sheets.
const Sheet* sheet_of_member(const Assembly& assembly, int member) {
  const Block* nearest = nullptr;
  for (const Block& block : assembly.blocks)
    if (!block.fixed && block.member >= member && (!nearest || block.member < nearest->member))
      nearest = &block;
  return nearest ? assembly.sheet_of(nearest->ring) : nullptr;
}

/// True if a fixed block bears this member or a copy, given by its name or by that of any of its wythes.
bool bears(const Assembly& assembly, const Block& support, const std::string& member) {
  if (is_of_member(assembly, support, member)) return true;
  const auto index_of = [&](const std::string& name) {
    return static_cast<int>(std::ranges::find(assembly.members, name) - assembly.members.begin());
  };
  const int named = index_of(member);
  const auto is_below = [&](int borne) {
    const Sheet* sheet = sheet_of_member(assembly, borne);
    if (!sheet || named == std::ssize(assembly.members)) return sheet && sheet->name == member;
    return sheet == sheet_of_member(assembly, named);
  };
  const bool is_listed = support.member < std::ssize(assembly.member_originals);
  return is_below(support.member) ||
         (is_listed && is_below(index_of(assembly.member_originals[support.member])));
}

/// The sheet about whose axis a block lies and from which it moves outwards: of a support that of the nearest
/// free block.
Sheet sheet_about(const Assembly& assembly, int block) {
  const Vec3& centroid = assembly.blocks[block].centroid;
  int ring = assembly.blocks[block].ring;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Block& b : assembly.blocks) {
    if (!assembly.blocks[block].fixed) break;
    if (b.fixed || (b.centroid - centroid).squaredNorm() >= nearest) continue;
    nearest = (b.centroid - centroid).squaredNorm();
    ring = b.ring;
  }
  const Sheet* vault = assembly.vault_of(ring);
  return vault ? *vault : assembly.axis_of(ring);
}

/// `distance` (m): of the centroid of the block from the axis.
void check_beside_axis(double distance, const Assembly& assembly, int block, const std::string& key) {
  if (distance < 1e-6 * std::cbrt(assembly.blocks[block].volume))
    throw InputError(fmt::format(
        "{}: block {} lies on the axis of the masonry, where a sector, a profile or a motion outwards has no "
        "direction; choose it by `blocks` and move it by `displacement`, or divide a fixed ring by "
        "geometry.base_blocks",
        key, block_label(assembly, block)));
}

/// rad, of the centroid about the axis of the masonry, from the x axis of that.
double azimuth_of(const Assembly& assembly, int block, const std::string& key) {
  const Vec3 own = sheet_about(assembly, block).own(assembly.blocks[block].centroid);
  check_beside_axis(own.head<2>().norm(), assembly, block, key);
  return std::atan2(own.y(), own.x());
}

bool is_in(const Sector& sector, double azimuth) {
  constexpr double kRounding = 1e-9;  // deg
  const double beyond = std::fmod(azimuth / kDegree - sector.from_deg + 720.0 + kRounding, 360.0);
  return beyond < sector.to_deg - sector.from_deg;
}

}  // namespace

std::vector<RegionBlock> blocks_of_region(const BlockRegion& region, const Assembly& assembly, bool fixed,
                                          const std::string& key) {
  const bool is_sheet =
      fixed && !assembly.members.empty() &&
      std::ranges::find(assembly.sheets, region.member, &Sheet::name) != assembly.sheets.end();
  if (!is_sheet) check_member_exists(assembly, region.member, key);
  check_blocks(region, assembly, fixed, key);
  std::vector<RegionBlock> found;
  for (int block = 0; block < static_cast<int>(assembly.blocks.size()); ++block) {
    const Block& b = assembly.blocks[block];
    const auto is_it = [block](const BlockRef& one) { return one.number == block; };
    if (b.fixed != fixed ||
        !(fixed ? bears(assembly, b, region.member) : is_of_member(assembly, b, region.member)) ||
        (!region.blocks.empty() && std::ranges::none_of(region.blocks, is_it)))
      continue;
    if (region.sector && !is_in(*region.sector, azimuth_of(assembly, block, key))) continue;
    const auto& profile = region.profile;
    const double factor =
        profile ? std::cos(profile->waves * (azimuth_of(assembly, block, key) - kDegree * profile->phase_deg))
                : 1.0;
    found.push_back({block, factor});
  }
  if (found.empty())
    throw InputError(fmt::format("{}: the region holds no {} block", key, fixed ? "fixed" : "free"));
  return found;
}

Vec3 outward_of_support(const Assembly& assembly, int block, const std::string& key) {
  const Vec3& centroid = assembly.blocks[block].centroid;
  const Sheet sheet = sheet_about(assembly, block);
  const std::optional<Vec3> outward = sheet.outward(centroid);
  if (!outward)
    throw InputError(fmt::format(
        "{}: nothing says what is outwards of block {}, which bears no vault; give a `displacement` or a "
        "`rotation_deg`, or to imported blocks geometry.import.axis",
        key, block_label(assembly, block)));
  const Vec3 own = sheet.own(centroid);
  const bool arch = sheet.thrust_lines == Sheet::ThrustLines::one;
  check_beside_axis(arch ? std::abs(own.x()) : own.head<2>().norm(), assembly, block, key);
  return *outward;
}

}  // namespace cupola
