#include "generators/surface/profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr double kKink = 1e-9;  // sine of the angle between two pieces that meet smoothly
constexpr int kPanels = 32;     // of the quadrature along a piece that is not even

bool meet_at_kink(const ProfilePiece& lower, const ProfilePiece& upper) {
  const Vec2 a = lower.derivative(1.0).normalized(), b = upper.derivative(0.0).normalized();
  return std::abs(cross(a, b)) > kKink || a.dot(b) < 0.0;
}

/// Length of a piece between two parameters, m: Gauss quadrature of order 10.
double arc_length(const ProfilePiece& piece, double from, double to) {
  constexpr std::array kNodes{0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array kWeights{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = kWeights[0] * piece.derivative(middle).norm();
  for (size_t i = 1; i < kNodes.size(); ++i)
    for (const double side : {-half, half})
      sum += kWeights[i] * piece.derivative(middle + side * kNodes[i]).norm();
  return half * sum;
}

}  // namespace

ProfilePiece line_piece(const Vec2& from, const Vec2& to) {
  return {[=](double t) -> Vec2 { return from + t * (to - from); }, [=](double) -> Vec2 { return to - from; },
          true, 0.0};
}

ProfilePiece arc_piece(const Vec2& centre, double radius, double from, double to) {
  const auto angle = [=](double t) { return from + (to - from) * t; };
  return {
      [=](double t) -> Vec2 { return centre + radius * Vec2(std::cos(angle(t)), std::sin(angle(t))); },
      [=](double t) -> Vec2 { return radius * (to - from) * Vec2(-std::sin(angle(t)), std::cos(angle(t))); },
      true, to - from};
}

ProfilePiece smooth_piece(std::function<Vec2(double)> at, std::function<Vec2(double)> derivative) {
  return {std::move(at), std::move(derivative), false, 0.0};
}

ProfilePiece piece_up_to(const ProfilePiece& piece, double end) {
  return {[=, at = piece.at](double t) { return at(end * t); },
          [=, derivative = piece.derivative](double t) -> Vec2 { return end * derivative(end * t); },
          piece.even, end* piece.turn};
}

ProfilePiece piece_from(const ProfilePiece& piece, double start) {
  const double rest = 1.0 - start;
  return {
      [=, at = piece.at](double t) { return at(start + rest * t); },
      [=, derivative = piece.derivative](double t) -> Vec2 { return rest * derivative(start + rest * t); },
      piece.even, rest* piece.turn};
}

std::vector<ProfilePiece> with_mirror_image(std::vector<ProfilePiece> pieces) {
  const size_t n = pieces.size();
  for (size_t i = n; i-- > 0;) {
    const ProfilePiece piece = pieces[i];
    pieces.push_back({[at = piece.at](double t) {
                        const Vec2 p = at(1.0 - t);
                        return Vec2(-p.x(), p.y());
                      },
                      [derivative = piece.derivative](double t) {
                        const Vec2 d = derivative(1.0 - t);
                        return Vec2(d.x(), -d.y());
                      },
                      piece.even, piece.turn});
  }
  return pieces;
}

ProfileBeds::ProfileBeds(std::vector<ProfilePiece> pieces, int rings, int rows_per_ring,
                         VaultSurface::Courses by, bool mirrored)
    : pieces_(std::move(pieces)), by_(by) {
  const int n = static_cast<int>(pieces_.size());
  double whole = 0.0;
  for (int i = 0; i < n; ++i) {
    if (i == 0 || meet_at_kink(pieces_[i - 1], pieces_[i])) runs_.push_back({i, i, 0.0, 0.0, {}, 0.0});
    Run& run = runs_.back();
    run.end = i + 1;
    run.sizes.push_back(size(i, 0.0, 1.0));
    if (!(run.sizes.back() > 0.0))
      throw InputError(
          fmt::format("geometry.surface.courses = {}: the piece of the profile from ({:.6g}, {:.6g}) m has "
                      "none to divide; "
                      "use length",
                      to_string(by), pieces_[i].at(0.0).x(), pieces_[i].at(0.0).y()));
    run.size += run.sizes.back();
    whole += run.sizes.back();
  }
  const bool crown_is_kink = mirrored && meet_at_kink(pieces_[n / 2 - 1], pieces_[n / 2]);
  if (crown_is_kink && rings % 2 != 0)
    throw InputError(fmt::format(
        "geometry.bond.rings = {}: must be even, because a pointed arch has a joint at the crown", rings));
  double below = 0.0;
  int bed = 0;
  for (Run& run : runs_) {
    below += run.size;
    const int end = static_cast<int>(std::lround(rings * below / whole));
    if (end <= bed)
      throw InputError(fmt::format(
          "geometry.bond.rings = {}: too few: every kink of the profile is a bed, and the piece from "
          "({:.6g}, {:.6g}) m is only {:.3g} m long",
          rings, pieces_[run.first].at(0.0).x(), pieces_[run.first].at(0.0).y(), run.size));
    run.bed_start = bed * rows_per_ring;
    run.bed_end = end * rows_per_ring;
    bed = end;
  }
  std::vector<double> places;
  for (int k = 0; k <= rings * rows_per_ring; ++k) places.push_back(place(k));
  places_ = std::move(places);
}

double ProfileBeds::size(int i, double from, double to) const {
  const ProfilePiece& piece = pieces_[i];
  if (by_ == VaultSurface::Courses::height) return std::abs(piece.at(to).y() - piece.at(from).y());
  if (by_ == VaultSurface::Courses::angle) {
    if (piece.even) return (to - from) * piece.turn;
    const Vec2 a = piece.derivative(from), b = piece.derivative(to);
    return std::atan2(cross(a, b), a.dot(b));
  }
  if (piece.even) return (to - from) * piece.derivative(0.5).norm();
  double sum = 0.0;
  const int panels = to - from > 1.0 / kPanels ? kPanels : 1;
  for (int p = 0; p < panels; ++p)
    sum += arc_length(piece, from + (to - from) * p / panels, from + (to - from) * (p + 1) / panels);
  return sum;
}

double ProfileBeds::inverse(int piece, double target, double whole) const {
  if (by_ != VaultSurface::Courses::height && pieces_[piece].even) return target / whole;
  double low = 0.0, high = 1.0, below = 0.0;
  for (int panel = 0; panel < kPanels; ++panel) {
    low = 1.0 * panel / kPanels;
    high = 1.0 * (panel + 1) / kPanels;
    const double here = size(piece, low, high);
    if (below + here >= target) break;
    if (panel + 1 < kPanels) below += here;
  }
  const double start = low;
  for (int i = 0; i < 60; ++i) {  // to rounding
    const double middle = 0.5 * (low + high);
    (below + size(piece, start, middle) < target ? low : high) = middle;
  }
  return high;
}

double ProfileBeds::place_in(const Run& run, double share) const {
  if (share == 0.0) return run.first;
  if (share == 1.0) return run.end;
  double rest = share * run.size;
  int piece = run.first;
  while (piece + 1 < run.end && rest > run.sizes[piece - run.first]) rest -= run.sizes[piece++ - run.first];
  return piece + inverse(piece, rest, run.sizes[piece - run.first]);
}

int ProfileBeds::run(double bed) const {
  const auto run = std::ranges::find_if(runs_, [&](const Run& r) { return bed <= r.bed_end; });
  return std::min(static_cast<int>(run - runs_.begin()), num_runs() - 1);
}

double ProfileBeds::place(double bed) const {
  const int whole = static_cast<int>(bed);
  if (whole == bed && whole >= 0 && whole < static_cast<int>(places_.size())) return places_[whole];
  const Run& in = runs_[run(bed)];
  return place_in(in, (bed - in.bed_start) / (in.bed_end - in.bed_start));
}

bool ProfileBeds::is_kink(double bed) const {
  return std::ranges::any_of(runs_.begin() + 1, runs_.end(),
                             [&](const Run& r) { return r.bed_start == bed; });
}

std::pair<int, double> ProfileBeds::piece_at(double place, int run) const {
  const int piece = std::clamp(static_cast<int>(std::ceil(place)) - 1, runs_[run].first, runs_[run].end - 1);
  return {piece, place - piece};
}

Vec2 ProfileBeds::point(double place, int run) const {
  const auto [piece, t] = piece_at(place, run);
  return pieces_[piece].at(t);
}

Vec2 ProfileBeds::derivative(double place, int run) const {
  const auto [piece, t] = piece_at(place, run);
  return pieces_[piece].derivative(t);
}

}  // namespace cupola
