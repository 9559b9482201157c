#include "generators/stereotomy/opening_places.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// A bed of a surface, on which the widths of an opening are measured.
struct Bed {
  const SurfaceMap& surface;
  double bed;

  /// m, on the intrados, between the abscissae at a distance `half` on both sides of `middle`.
  double chord(double middle, double half) const {
    return (surface.intrados(bed, middle + half) - surface.intrados(bed, middle - half)).norm();
  }
};

/// The range of the abscissa up to the nearest corner of the plan, half-way to the next opening of the group,
/// or a quarter of the ring, beyond which chords become shorter.
double room_beside(const SurfaceMap& surface, double middle, const std::vector<double>& middles) {
  double room = 0.25 * surface.extent;
  const auto distance = [&](double a) { return std::abs(std::remainder(a - middle, surface.extent)); };
  for (const double corner : surface.corners) room = std::min(room, distance(corner));
  for (const double other : middles)
    if (other != middle) room = std::min(room, 0.5 * distance(other));
  return room;
}

/// Half the range of the abscissa of a chord that fits into the room on both sides.
double half_range(const Bed& on, double middle, double room, double width) {
  double low = 0.0, high = room;
  if (on.chord(middle, room) <= width) return room;
  for (int i = 0; i < 60; ++i) {  // to rounding
    const double half = 0.5 * (low + high);
    (on.chord(middle, half) < width ? low : high) = half;
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

/// The ring above the bed at a height (m) above the springing, which an edge of an opening must meet.
int ring_at(const SurfaceMap& surface, double height, const char* what, const std::string& key) {
  const auto level = [&](int ring) { return surface.height(ring * surface.rows_per_ring); };
  int above = 0;
  while (above < surface.num_rings() && level(above) < height) ++above;
  const int below = std::max(above - 1, 0);
  const int nearest = std::abs(level(above) - height) < std::abs(level(below) - height) ? above : below;
  constexpr double kSame = 1e-6;  // of the height of a course
  if (std::abs(level(nearest) - height) < kSame * (level(below + 1) - level(below))) return nearest;
  throw InputError(
      fmt::format("{}: {} at {:.6g} m {}; the beds beside it lie at {:.6g} and {:.6g} m", key, what, height,
                  height > level(surface.num_rings()) ? "lies above the last bed" : "lies between two beds",
                  level(below), level(above)));
}

/// True if an opening or its lintel takes from the lintel of another more on one side of its middle than on
/// the other, so that it rests on one bearing only. Of openings on one axis the upper ones cut it evenly.
bool unbalances(const OpeningPlace& place, const OpeningPlace& lintel, double extent) {
  const double from_middle = std::remainder(place.middle - lintel.middle, extent);
  const double end = lintel.half_lintel - 1e-9 * extent;  // nearer edges coincide, as in lay_openings()
  const auto cuts = [&](double half, int first_ring, int end_ring) {
    const double left = from_middle - half, right = from_middle + half;
    const bool overlaps =
        first_ring < lintel.end_lintel && end_ring > lintel.first_lintel && right > -end && left < end;
    const bool is_even = (left > -end) == (right < end) && left < 0.0 && right > 0.0;
    return overlaps && !is_even;
  };
  return cuts(place.half_opening, place.first_ring, place.first_lintel) ||
         cuts(place.half_lintel, place.first_lintel, place.end_lintel);
}

void refuse_overlaps(const std::vector<OpeningPlace>& places, const SurfaceMap& surface,
                     const std::string& key) {
  const OpeningPlace& last = places.back();
  for (const OpeningPlace& other : places) {
    if (!unbalances(last, other, surface.extent) && !unbalances(other, last, surface.extent)) continue;
    const Vec3 at = surface.intrados(last.first_ring * surface.rows_per_ring, last.middle);
    throw InputError(
        fmt::format("{}: the opening about ({:.4g}, {:.4g}, {:.4g}) m or its lintel overlaps another beside "
                    "the middle, so that a lintel rests on one side only: move one, or make it narrower",
                    key, at.x(), at.y(), at.z()));
  }
}

void add_places(const Openings& group, const SurfaceMap& surface, const std::string& key,
                std::vector<OpeningPlace>* places) {
  const double top = group.sill + group.height;
  const int first = ring_at(surface, group.sill, "the sill", key);
  const int lintel = ring_at(surface, top, "the top", key);
  if (lintel == surface.num_rings())
    throw InputError(
        fmt::format("{}: no room for a lintel above the opening, which ends {:.6g} m below the last bed", key,
                    surface.height(surface.num_rows) - top));
  const int end =
      group.lintel > 0.0 ? ring_at(surface, top + group.lintel, "the top of the lintel", key) : lintel + 1;
  const Bed sill{surface, 1.0 * first * surface.rows_per_ring};
  const Bed bearing{surface, 1.0 * lintel * surface.rows_per_ring};
  const std::vector<double> middles = middles_of(group, surface, key);
  for (const double middle : middles) {
    const double room = room_beside(surface, middle, middles);
    const double half = half_range(sill, middle, room, group.width);
    // Radial jambs approach each other or part where the inner face leans
    const double parted = bearing.chord(middle, half) - sill.chord(middle, half);
    const double whole = group.width + parted + 2.0 * group.bearing, most = bearing.chord(middle, room);
    // Rounding of the plan's coordinates, a few 1e-16 of its size
    if (whole > most * (1.0 + 1e-12))
      throw InputError(
          fmt::format("{}.width = {}: with a bearing of {} m on each side the lintel is {:.6g} m long, but "
                      "there are only {:.6g} m up to a corner or the next opening",
                      key, group.width, group.bearing, whole, most));
    places->push_back({middle, half, half_range(bearing, middle, room, whole), first, lintel, end});
    refuse_overlaps(*places, surface, key);
  }
}

}  // namespace

std::vector<OpeningPlace> opening_places(const std::vector<Openings>& openings, const SurfaceMap& surface,
                                         const std::string& key) {
  std::vector<OpeningPlace> places;
  if (!openings.empty() && !surface.closed)
    throw InputError(
        key +
        ": requires a closed plan; in a plane wall draw windows and their lintels as letters of a "
        "bond of `type: drawn`, or take windows alone away by `cuts`");
  for (size_t i = 0; i < openings.size(); ++i)
    add_places(openings[i], surface, fmt::format("{}[{}]", key, i), &places);
  return places;
}

}  // namespace cupola
