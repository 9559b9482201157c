#include "generators/stereotomy/drum.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/bond/openings.hpp"
#include "generators/bond/wythe_bond.hpp"
#include "generators/surface/drum.hpp"

namespace cupola {
namespace {

/// m, on the intrados, between the abscissae at a distance `half` on both sides of `middle`.
double chord(const SurfaceMap& surface, double middle, double half) {
  return (surface.intrados(0.0, middle + half) - surface.intrados(0.0, middle - half)).norm();
}

/// The range of the abscissa up to the nearest corner of the plan, half-way to the next opening of the group, or a quarter of
/// the ring, beyond which chords become shorter.
double room_beside(const SurfaceMap& surface, double middle, const std::vector<double>& middles) {
  double room = 0.25 * surface.extent;
  const auto distance = [&](double a) { return std::abs(std::remainder(a - middle, surface.extent)); };
  for (const double corner : surface.corners) room = std::min(room, distance(corner));
  for (const double other : middles)
    if (other != middle) room = std::min(room, 0.5 * distance(other));
  return room;
}

/// Half the range of the abscissa of a chord that fits into the room on both sides.
double half_range(const SurfaceMap& surface, double middle, double room, double width) {
  double low = 0.0, high = room;
  if (chord(surface, middle, room) <= width) return room;
  for (int i = 0; i < 60; ++i) {  // to rounding
    const double half = 0.5 * (low + high);
    (chord(surface, middle, half) < width ? low : high) = half;
  }
  return high;
}

std::vector<double> middles_of(const Openings& group, const SurfaceMap& surface, const std::string& key) {
  const int per_ring = group.per_ring > 0 ? group.per_ring : static_cast<int>(surface.corners.size());
  if (per_ring == 0)
    throw InputError(key + ".per_ring = 0: a round plan has no sides; give the number of openings");
  const double first = surface.corners.empty() ? 0.0 : surface.corners.front();
  std::vector<double> middles;
  for (int i = 0; i < per_ring; ++i)
    for (const double at : group.at) middles.push_back(first + (i + at) * surface.extent / per_ring);
  return middles;
}

void add_places(const Openings& group, const SurfaceMap& surface, double course, const std::string& key,
                std::vector<OpeningPlace>* places) {
  const auto bed = [&](double height) { return static_cast<int>(std::lround(height / course)); };
  const double top = group.sill + group.height, lintel = group.lintel > 0.0 ? group.lintel : course;
  const std::vector<double> middles = middles_of(group, surface, key);
  for (const double middle : middles) {
    const double room = room_beside(surface, middle, middles), whole = group.width + 2.0 * group.bearing;
    const double most = chord(surface, middle, room);
    // Rounding of the plan's coordinates, a few 1e-16 of its size
    if (whole > most * (1.0 + 1e-12))
      throw InputError(
          fmt::format("{}.width = {}: with a bearing of {} m on each side the lintel is {:.6g} m long, but "
                      "there are only {:.6g} m up to a corner or the next opening",
                      key, group.width, group.bearing, whole, most));
    places->push_back({middle, half_range(surface, middle, room, group.width),
                       half_range(surface, middle, room, whole), bed(group.sill), bed(top),
                       bed(top + lintel)});
  }
}

/// Bonds do not know where they are laid, and their errors name the keys of the shell.
BondPattern lay_wall(const Drum& drum, const SurfaceMap& surface, const BondGrid& grid) {
  try {
    return lay_masonry(drum, surface, grid);
  } catch (const InputError& error) {
    const std::string text = error.what();  // begins with "error: "
    throw InputError("in geometry.drum: " + text.substr(text.find(' ') + 1));
  }
}

std::vector<std::string> names_of_members(const Drum& drum) {
  std::vector<std::string> names = member_names(drum);
  for (std::string& name : names) name = "drum " + name;
  if (names.empty()) names = {"drum"};
  return names;
}

}  // namespace

Storey make_drum(const Drum& drum, const SurfaceMap& shell) {
  const int courses = rings_of(*finest_bond(drum));
  SurfaceMap surface = drum_surface(
      shell, drum.height,
      drum.wythes.empty() ? std::vector<Thickness>{{{}, {drum.thickness}}} : thicknesses(drum.wythes),
      courses);
  const BondGrid grid{courses, true, surface.extent, surface.corners, false, 0};
  BondPattern bond = lay_wall(drum, surface, grid);
  std::vector<std::string> names = names_of_members(drum);
  std::vector<OpeningPlace> places;
  for (size_t i = 0; i < drum.openings.size(); ++i)
    add_places(drum.openings[i], surface, drum.height / courses, fmt::format("geometry.drum.openings[{}]", i),
               &places);
  if (!places.empty()) {
    lay_openings(grid, places, static_cast<int>(names.size()), &bond);
    names.emplace_back("drum lintel");
  }
  return {"drum", std::move(surface), std::move(bond), std::move(names), 0};
}

}  // namespace cupola
