#include "generators/surface/sail_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/surface/secant.hpp"

namespace cupola {
namespace {

using enum OctagonalVault::Extrados;
using Beds = VaultSurface::Beds;

Vec2 scaled(const Vec2& v, double factor) {
  return {factor * v.x(), v.y()};
}

/// Where f, a distance from a bed (m), is zero near a place of a layer. Throws where the bed passes it by, as
/// a level one above the crown of the intrados does.
template <class Function>
double place_on(const Function& f, double place, Beds beds, double height, double depth) {
  constexpr double kMet = 1e-9;  // m; roots are accurate to the rounding of coordinates, 1e-13 m at 1 km
  const double root = f(place) == 0.0 ? place : secant_root(f, place, place + 1e-3);
  if (!(std::abs(f(root)) < kMet))
    throw InputError(fmt::format(
        "geometry.surface.beds = {}: the bed at z = {:.6g} m of the profile does not meet {}; choose a "
        "larger eye, another `line` or beds: normal",
        to_string(beds), height,
        depth == 0.0 ? "the intrados" : fmt::format("the layer {:.4g} m behind the intrados", depth)));
  return root;
}

/// Outwards, of a bed that is plane in each sail.
Vec2 direction_of(const SailSection& section, Beds beds, double bed) {
  return beds == Beds::level   ? Vec2(1.0, 0.0)
         : beds == Beds::given ? section.given_direction(bed)
                               : section.normal_of(bed, section.beds->place(bed), section.middle);
}

/// The place where such a bed meets the layer of a run, which continues beyond its ends.
double place_met(const SailSection& section, Beds beds, double bed, int run, double depth) {
  const double place = section.beds->place(bed);
  if (beds == Beds::normal && !section.beds->is_kink(bed)) return place;
  const Vec2 on_line = section.point(bed, place, section.middle), along = direction_of(section, beds, bed);
  const auto off_bed = [&](double u) -> double {
    return cross(section.layer(u, run, depth) - on_line, along);
  };
  return place_on(off_bed, place, beds, on_line.y(), depth);
}

/// The integral of at_axis r + per_r r^2 / 2 over z along a straight line.
double along_chord(const Vec2& a, const Vec2& b, double at_axis, double per_r) {
  const double r = 0.5 * (a.x() + b.x()), square = (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 3.0;
  return (b.y() - a.y()) * (at_axis * r + 0.5 * per_r * square);
}

/// The same along a smooth curve from one place to another, exact to rounding: Romberg's rule, because the
/// error of n chords has only even powers of 1/n.
template <class Curve>
double along_curve(const Curve& curve, double from, double to, double at_axis, double per_r) {
  std::array<double, 8> table{};  // of half as many chords, by the number of extrapolations
  for (size_t level = 0; level < table.size(); ++level) {
    const int n = 1 << level;
    double sum = 0.0, power = 1.0;
    for (int i = 0; i < n; ++i)
      sum += along_chord(curve(std::lerp(from, to, 1.0 * i / n)), curve(std::lerp(from, to, (i + 1.0) / n)),
                         at_axis, per_r);
    for (size_t j = 0; j < level; ++j) {
      power *= 4.0;
      const double better = sum + (sum - table[j]) / (power - 1.0);
      table[j] = std::exchange(sum, better);
    }
    table[level] = sum;
  }
  return table.back();
}

}  // namespace

Vec2 outward_normal(const Vec2& derivative) {
  return Vec2(derivative.y(), -derivative.x()).normalized();
}

Vec2 SailSection::point(double bed, double place, double factor) const {
  return scaled(beds->point(place, beds->run(bed)), factor);
}

Vec2 SailSection::normal_of(double bed, double place, double factor) const {
  const int run = beds->run(bed);
  const Vec2 n = outward_normal(scaled(beds->derivative(place, run), factor));
  if (!beds->is_kink(bed)) return n;
  return (n + outward_normal(scaled(beds->derivative(place, run + 1), factor))).normalized();
}

Vec2 SailSection::given_direction(double bed) const {
  const double end = mirrored ? 0.5 * num_rows : num_rows;
  const bool beyond = mirrored && bed > end;
  const double spans = static_cast<double>(bed_angles.size() - 1);
  const double at = std::clamp((beyond ? num_rows - bed : bed) / end * spans, 0.0, spans);
  const size_t i = std::min(static_cast<size_t>(at), bed_angles.size() - 2);
  const double angle = std::lerp(bed_angles[i], bed_angles[i + 1], at - static_cast<double>(i));
  return {beyond ? -std::cos(angle) : std::cos(angle), std::sin(angle)};
}

Vec2 SailSection::layer(double place, int run, double from_intrados) const {
  const double depth = from_intrados - drawn_depth;
  const Vec2 p = beds->point(place, run), d = beds->derivative(place, run);
  if (depth == 0.0) return scaled(p, middle);
  if (extrados == normal) return scaled(p, middle) + depth * outward_normal(scaled(d, middle));
  if (extrados == OctagonalVault::Extrados::bed) return scaled(p, middle) + Vec2(depth, 0.0);
  const double along = extrados == midsail ? depth * corner / middle : depth;
  return scaled(scaled(p, corner) + along * outward_normal(scaled(d, corner)), middle / corner);
}

int SailSection::run_met(double bed, double place, const Vec2& along, double from_intrados) const {
  const double depth = from_intrados - drawn_depth;
  const bool meets_upper = beds->is_kink(bed) && depth * cross(normal_of(bed, place, middle), along) > 0.0;
  return beds->run(bed) + (meets_upper ? 1 : 0);
}

Vec2 plane_bed_point(const SailSection& section, Beds beds, double bed, double depth) {
  const double place = section.beds->place(bed);
  const Vec2 along = direction_of(section, beds, bed);
  const int run = section.run_met(bed, place, along, depth);
  const Vec2 p = section.layer(place_met(section, beds, bed, run, depth), run, depth);
  return {p.x(), beds == Beds::level ? section.point(bed, place, section.middle).y() : p.y()};
}

Vec2 conical_bed_point(const SailSection& section, double bed, double depth, double q) {
  const double place = section.beds->place(bed);
  const Vec2 on_corner = section.point(bed, place, section.corner),
             n = section.normal_of(bed, place, section.corner);
  const int run = section.beds->run(bed);
  const auto beside = [&](double u) {
    const Vec2 p = section.layer(u, run, depth);
    return (q * p.x() - on_corner.x()) * n.y() - (p.y() - on_corner.y()) * n.x();
  };
  const double met = place_on(beside, place, Beds::conical, on_corner.y(), depth);
  const Vec2 p = section.layer(met, run, depth);
  const double rho = q * p.x();
  return {rho, std::abs(n.x()) < 0.1 ? p.y() : on_corner.y() + (rho - on_corner.x()) * n.y() / n.x()};
}

double section_integral(const SailSection& section, Beds beds, double thickness, double at_axis,
                        double per_r) {
  const ProfileBeds& line = *section.beds;
  double sum = 0.0;
  for (const double depth : {0.0, thickness}) {
    int run = 0;
    const auto layer = [&](double place) { return section.layer(place, run, depth); };
    double along = 0.0, from = place_met(section, beds, 0.0, run, depth);
    for (int bed = 1; bed <= section.num_rows; ++bed) {
      const bool is_last = bed == section.num_rows;
      if (!is_last && !line.is_kink(bed)) continue;
      const double to = place_met(section, is_last ? beds : Beds::normal, bed, run, depth);
      while (from < to) {
        const double end = std::min(std::floor(from) + 1.0, to);  // of a piece
        along += along_curve(layer, from, end, at_axis, per_r);
        from = end;
      }
      if (!is_last) from = place_met(section, Beds::normal, bed, ++run, depth);
    }
    sum += depth > 0.0 ? along : -along;
  }
  const auto across = [&](double bed) {
    return along_chord(plane_bed_point(section, beds, bed, 0.0),
                       plane_bed_point(section, beds, bed, thickness), at_axis, per_r);
  };
  return sum + across(0.0) - across(section.num_rows);
}

}  // namespace cupola
