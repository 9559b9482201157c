#include "generators/stereotomy/placement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// z of a bed that is level, m. `what` names it in the message if it is not.
double level_of(const SurfaceMap& surface, double bed, const std::string& what) {
  const double z = surface.intrados(bed, surface.first_corner).z();
  double farthest = 0.0;
  constexpr int kSteps = 8;
  for (int i = 0; i <= kSteps; ++i)
    for (const int layer : {0, surface.num_wythes()})
      farthest = std::max(farthest, std::abs(surface.point(bed, surface.extent * i / kSteps, layer).z() - z));
  const double size = (surface.intrados(bed, 0.0) - surface.extrados(bed, 0.0)).norm();
  if (farthest > 1e-9 * size)
    throw InputError(
        fmt::format("{} is not level: it rises or falls by {:.3g} m; a member stands on a level bed: give "
                    "its surface beds: level, or beds: given with an angle of 0 there",
                    what, farthest));
  return z;
}

/// The largest coordinate of a member along a horizontal direction of its own frame, m. A plane cut across
/// that direction ends it; a joint does not.
double reach(const Storey& storey, const Vec3& direction) {
  const SurfaceMap& surface = storey.surface;
  double farthest = -std::numeric_limits<double>::infinity();
  const auto include = [&](const Vec3& p) { farthest = std::max(farthest, direction.dot(p)); };
  if (surface.webs > 0) {
    const double apothem = surface.extent, half_angle = std::numbers::pi / surface.webs;
    for (int corner = 0; corner < surface.webs; ++corner) {
      const double a = std::numbers::pi / 2 + (2 * corner + 1) * half_angle;
      const Vec3 p = apothem / std::cos(half_angle) * Vec3(std::cos(a), std::sin(a), 0.0);
      include(storey.affine ? storey.affine->image(p) : p);
    }
  } else {
    for (int bed = 0; bed <= surface.num_rows; ++bed)
      for (const double abscissa : storey.bond.cuts)
        for (const int layer : {0, surface.num_wythes()}) include(surface.point(bed, abscissa, layer));
  }
  for (const Cut& cut : storey.cuts)
    if (cut.kind == Cut::Kind::plane && cut.as != Cut::As::joint &&
        cut.normal.normalized().dot(direction) > 1.0 - 1e-12)
      farthest = std::min(farthest, direction.dot(cut.point));
  return farthest;
}

/// The motion from one copy to the next.
Eigen::Isometry3d step_of(const Copies& copies) {
  if (!copies.about) return Eigen::Isometry3d(Eigen::Translation3d(copies.by));
  const double turn = 2.0 * std::numbers::pi / copies.count;
  return Eigen::Translation3d(*copies.about) * Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) *
         Eigen::Translation3d(-*copies.about);
}

/// The reflection in a plane.
Eigen::Isometry3d reflection_in(const Mirror& mirror) {
  const Vec3 normal = mirror.normal.normalized();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() -= 2.0 * normal * normal.transpose();
  motion.translation() = 2.0 * normal.dot(mirror.point) * normal;
  return motion;
}

/// The motions from a member to its copies, or to its mirror image.
std::vector<Eigen::Isometry3d> motions_to_copies(const Member& member) {
  if (member.mirror) return {reflection_in(*member.mirror)};
  std::vector<Eigen::Isometry3d> motions;
  if (!member.copies) return motions;
  const Eigen::Isometry3d own = placement_at(member.at.value_or(Place{}));
  for (const Place& place : member.copies->at) motions.push_back(placement_at(place) * own.inverse());
  for (int copy = 2; copy <= member.copies->count; ++copy)
    motions.push_back(step_of(*member.copies) *
                      (motions.empty() ? Eigen::Isometry3d::Identity() : motions.back()));
  return motions;
}

/// The axis of a groin vault on copies of a member.
Vec3 axis_on(const Member& bearer, const Storey& lower) {
  Vec3 axis = lower.placement.translation();
  if (!bearer.copies) return axis;
  if (bearer.copies->about) return *bearer.copies->about;
  const std::vector<Eigen::Isometry3d> motions = motions_to_copies(bearer);
  for (const Eigen::Isometry3d& motion : motions) axis += motion * lower.placement.translation();
  return axis / (1.0 + static_cast<double>(motions.size()));
}

/// True if the plane of a mirror is that of symmetry of an arch: it halves the distance of its springings.
bool maps_onto_itself(const Mirror& mirror, const Storey& arch) {
  constexpr double kRounding = 1e-9;  // m per m
  const Vec3 first = arch.placement * arch.surface.intrados(0, 0.0),
             last = arch.placement * arch.surface.intrados(arch.surface.num_rows, 0.0);
  const Vec3 image = reflection_in(mirror) * first;
  return (image - last).norm() <= kRounding * (first.norm() + last.norm());
}

}  // namespace

double level_of_springers(const Storey& vault) {
  const double low = std::min(vault.surface.intrados(0, 0.0).z(), vault.surface.extrados(0, 0.0).z());
  return vault.affine ? vault.affine->scale.z() * low : low;
}

Eigen::Isometry3d placement_at(const Place& place) {
  constexpr double kRadians = std::numbers::pi / 180.0;
  return Eigen::Translation3d(place.origin) *
         Eigen::AngleAxisd(place.rotate_deg * kRadians, Eigen::Vector3d::UnitZ());
}

void stand_on(const std::string& key, const Member& bearer, const Member& member, const Storey& lower,
              Storey* storey) {
  const std::string on = fmt::format("{}.on = {}: ", key, lower.name);
  if (lower.surface.carries && !lower.bears_another)
    throw InputError(on + "nothing can stand on its last bed, behind which a support or a key stone lies");
  const double top = level_of(lower.surface, lower.surface.num_rows, on + "its last bed");
  storey->surface.first_bed_held = false;
  if (storey->surface.webs > 0) {
    if (storey->surface.springers == 0 || (storey->affine && storey->affine->rake != 0.0))
      throw InputError(
          fmt::format("{}the first beds of {} are not level: a member stands on level beds; give "
                      "plan.springers, and no rake",
                      on, storey->name));
    const double rise = lower.placement.translation().z() + top - level_of_springers(*storey);
    if (!member.at) storey->placement.translation() = axis_on(bearer, lower);
    storey->placement.translation().z() = rise;
    return;
  }
  const double foot = level_of(storey->surface, 0.0, on + "the first bed of " + storey->name);
  if (member.at && !storey->surface.last_bed_held)
    throw InputError(fmt::format(
        "{}.at: a member that stands on {} lies on its axis: leave out `at`; only groin vaults and "
        "arches with two springings have a place of their own, their feet on what ends at that "
        "level",
        key, lower.name));
  if (member.at)
    storey->placement.translation().z() = lower.placement.translation().z() + top - foot;
  else
    storey->placement = lower.placement * Eigen::Translation3d(0.0, 0.0, top - foot);
  if (member.at ||
      (storey->surface.last_bed_held && bearer.mirror && maps_onto_itself(*bearer.mirror, *storey))) {
    level_of(storey->surface, storey->surface.num_rows, on + "the last bed of " + storey->name);
    storey->surface.last_bed_held = false;
    return;
  }
  storey->stands_on_previous = true;
}

void stand_beside(const Beside& beside, const std::string& key, const std::vector<Storey>& storeys,
                  Storey* storey) {
  const auto other = std::ranges::find(storeys, beside.member, &Storey::name);
  if (other == storeys.end()) {
    std::vector<std::string> names;
    for (const Storey& before : storeys) names.push_back(before.name);
    const std::string near = nearest_name(beside.member, names);
    throw InputError(fmt::format("{}.beside.member = {}: must be a member before {} in the list{}", key,
                                 beside.member, storey->name,
                                 near.empty() ? "" : fmt::format("; did you mean {}?", near)));
  }
  using enum Beside::Side;
  const bool along_x = beside.side == right || beside.side == left;
  const double sign = beside.side == right || beside.side == behind ? 1.0 : -1.0;
  const Vec3 out = sign * (along_x ? Vec3::UnitX() : Vec3::UnitY());
  const Vec3 own_in = storey->placement.linear().transpose() * -out;
  const double plane = reach(*other, out);
  const double own = reach(*storey, own_in);  // of the side that faces the other member
  const double shift = plane + own - out.dot(storey->placement.translation());
  storey->beside = beside.member;
  storey->limits.push_back({own_in, own});
  storey->placement = other->placement * Eigen::Translation3d(shift * out) * storey->placement;
}

void limit_neighbours(std::vector<Storey>* storeys) {
  std::vector<std::pair<Storey*, Plane>> limits;
  for (const Storey& one : *storeys)
    for (const Plane& limit : one.limits) {
      const Vec3 normal = one.placement.linear() * limit.normal;  // of the world
      const double offset = limit.offset + normal.dot(one.placement.translation());
      for (Storey& other : *storeys) {
        if (&one == &other) continue;
        const Plane own{other.placement.linear().transpose() * -normal,
                        normal.dot(other.placement.translation()) - offset};
        constexpr double kTouches = 1e-9;  // m per m from the origin
        if (std::abs(reach(other, own.normal) - own.offset) <= kTouches * (1.0 + std::abs(offset)))
          limits.emplace_back(&other, own);
      }
    }
  for (auto& [storey, limit] : limits) storey->limits.push_back(limit);
}

void copy_stack(const Member& member, size_t first, std::vector<Storey>* storeys) {
  const size_t end = storeys->size();
  int copy = 1;
  for (const Eigen::Isometry3d& motion : motions_to_copies(member)) {
    ++copy;
    for (size_t i = first; i < end; ++i) {
      Storey storey = (*storeys)[i];
      storey.name += fmt::format(" {}", copy);
      storey.beside.clear();  // the first one stands there
      storey.originals = storey.members;
      for (std::string& label : storey.members) label += fmt::format(" {}", copy);
      storey.placement = motion * storey.placement;
      storey.surface.rings_below = storeys->back().surface.rings_below + storeys->back().num_rings();
      storeys->push_back(std::move(storey));
    }
  }
}

}  // namespace cupola
