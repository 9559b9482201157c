#include "assembly/model/applied_loads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/face_loads.hpp"
#include "assembly/model/loaded_faces.hpp"
#include "assembly/model/loads_on_top.hpp"
#include "assembly/model/open_tops.hpp"

namespace cupola {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// "; its courses are 6 to 11", counted through all members; "" without a free block.
std::string courses_of(const Assembly& assembly, const std::string& member) {
  int low = kLastRing, high = -1;
  for (const Block& block : assembly.blocks) {
    if (block.fixed || !is_of_member(assembly, block, member)) continue;
    low = std::min(low, block.ring);
    high = std::max(high, block.ring);
  }
  return high < 0 ? "" : fmt::format("; {} courses are {} to {}", member.empty() ? "the" : "its", low, high);
}

void add_shared_force(const BlockForce& load, const Assembly& assembly, const std::string& key, int time,
                      std::vector<PointForce>* forces) {
  const SharingBlocks& over = *load.over;
  check_member_exists(assembly, over.member, key);
  const auto carries = [&](const Block& block) {
    return !block.fixed && (over.course < 0 || block.ring == over.course) &&
           is_of_member(assembly, block, over.member);
  };
  double volume = 0.0;
  for (const Block& block : assembly.blocks)
    if (carries(block)) volume += block.volume;
  if (volume == 0.0)
    throw InputError(fmt::format("{}: no free block{}{} to carry the force{}", key,
                                 over.course >= 0 ? fmt::format(" in course {}", over.course) : "",
                                 over.member.empty() ? "" : " of member " + over.member,
                                 courses_of(assembly, over.member)));
  for (size_t b = 0; b < assembly.blocks.size(); ++b)
    if (const Block& block = assembly.blocks[b]; carries(block))
      forces->push_back({static_cast<int>(b), block.centroid, block.volume / volume * load.force, time});
}

/// On the upper faces of the masonry, wherever its extrados or the top of a wall lies below the rectangle.
std::vector<SpreadShare> shares_of(const BlockForce& load, const Assembly& assembly, const std::string& key) {
  const Vec3& point = load.point.value();
  std::vector<LoadedFace> faces = open_parts(
      assembly, faces_of_kind(assembly, std::array{FaceKind::extrados}, 0, kLastRing, ""), point.z());
  std::ranges::move(open_tops(assembly, 0, kLastRing, "", false, point.z()), std::back_inserter(faces));
  std::vector<SpreadShare> shares = spread_shares(*load.spread, point, faces);
  if (shares.empty())
    throw InputError(
        fmt::format("{}: no extrados lies below the rectangle of {:g} by {:g} m about ({:g}, {:g}, {:g}) m",
                    key, load.spread->x, load.spread->y, point.x(), point.y(), point.z()));
  return shares;
}

/// Two couples at right angles, of equal share. Together they have no symmetric moment, which would pass for
/// stress.
void add_moment(const Vec3& moment, int number, const Block& block, int time,
                std::vector<PointForce>* forces) {
  if (moment.norm() == 0.0) return;
  const double arm = 0.5 * std::cbrt(block.volume), force = moment.norm() / (4.0 * arm);  // m, N
  const Vec3 axis = moment.normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
  for (const double sign : {1.0, -1.0}) {
    forces->push_back({number, block.centroid + sign * arm * u, sign * force * v, time, true});
    forces->push_back({number, block.centroid + sign * arm * v, -sign * force * u, time, true});
  }
}

void add_block_force(const BlockForce& load, const Assembly& assembly, const std::string& key, int time,
                     std::vector<PointForce>* forces) {
  if (load.over) return add_shared_force(load, assembly, key, time, forces);
  if (load.spread) {
    for (const SpreadShare& s : shares_of(load, assembly, key))
      forces->push_back({s.block, s.point, s.share * load.force, time});
    return;
  }
  const bool at_point = load.block == BlockForce::kAtPoint;
  const std::string chosen_by = key + (at_point ? ".point" : ".block");
  const int number = at_point ? block_at(assembly, load.point.value(), chosen_by) : load.block.number;
  check_block_exists(assembly, number, chosen_by);
  const Block& block = assembly.blocks[number];
  if (block.fixed)
    throw InputError(
        fmt::format("{}: block {} is fixed; apply the force to a free block", chosen_by, number));
  forces->push_back({number, load.point.value_or(block.centroid), load.force, time});
  if (load.moment) add_moment(*load.moment, number, block, time, forces);
}

}  // namespace

std::vector<PointForce> applied_loads(const Loads& loads, const Assembly& assembly) {
  std::vector<PointForce> forces;
  add_loads_on_top(loads, assembly, &forces);
  int time = 0;
  for (size_t i = 0; i < loads.forces.size(); ++i)
    add_block_force(loads.forces[i], assembly, fmt::format("loads.forces[{}]", i), time++, &forces);
  for (size_t i = 0; i < loads.faces.size(); ++i)
    add_face_load(loads.faces[i], assembly, fmt::format("loads.faces[{}]", i), loads, time++, &forces);
  return forces;
}

double share_beside(const BlockForce& load, const Assembly& assembly) {
  double met = 0.0;
  for (const SpreadShare& s : shares_of(load, assembly, "loads.forces")) met += s.share;
  return 1.0 - met;
}

std::vector<TimeFunction> load_times(const Loads& loads) {
  std::vector<TimeFunction> times;
  for (const BlockForce& load : loads.forces) times.push_back(load.time);
  for (const FaceLoad& load : loads.faces)
    times.push_back(is_dead_load(load) ? loads.dead_load_time : load.time);
  return times;
}

double load_factor(int of_force, const TimeFunction& dead_load_time, const std::vector<TimeFunction>& times,
                   double time) {
  if (of_force == PointForce::kSteady) return 1.0;
  return factor_at(of_force == PointForce::kDeadLoad ? dead_load_time : times[of_force], time);
}

}  // namespace cupola
