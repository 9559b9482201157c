#pragma once

#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "assembly/case/geometry.hpp"

namespace cupola {

using Vec2 = Eigen::Vector2d;
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A smooth piece of a profile: (r, z) in m over t from 0 to 1. Both functions continue beyond its ends.
struct ProfilePiece {
  std::function<Vec2(double)> at, derivative;
  bool even = false;  ///< t is proportional to the length, as on lines and arcs
  double turn = 0.0;  ///< rad, of the normal from end to end, positive to the left; of even pieces only
};
ProfilePiece line_piece(const Vec2& from, const Vec2& to);
/// An arc between two angles (rad, from the direction of r towards that of z).
ProfilePiece arc_piece(const Vec2& centre, double radius, double from, double to);
/// A curve by any smooth parameter, from 0 to 1.
ProfilePiece smooth_piece(std::function<Vec2(double)> at, std::function<Vec2(double)> derivative);
/// The part of a piece up to t, or from t on.
ProfilePiece piece_up_to(const ProfilePiece& piece, double t);
ProfilePiece piece_from(const ProfilePiece& piece, double t);

/// The pieces and, behind them, their mirror images in the plane r = 0, so that the profile comes down again.
std::vector<ProfilePiece> with_mirror_image(std::vector<ProfilePiece> pieces);

/// Where the beds of a profile lie. The profile consists of runs, smooth chains of pieces between kinks;
/// every kink is a bed. Each run gets the number of courses nearest to its share, of equal length or of equal
/// height.
///
/// A place on the profile is u = number of the piece + t.
class ProfileBeds {
 public:
  /// Throws InputError if a run would have no course or the crown of a mirrored profile no bed. `mirrored`:
  /// the second half is the mirror image of the first.
  ProfileBeds(std::vector<ProfilePiece> pieces, int rings, int rows_per_ring, VaultSurface::Courses by,
              bool mirrored);

  /// The place of a bed, which may be fractional; at a kink that between the two runs.
  double place(double bed) const;
  /// The run of a bed, at a kink the lower one.
  int run(double bed) const;
  /// True for the beds between two runs.
  bool is_kink(double bed) const;
  /// Of a run, which continues beyond its ends: offset curves have gaps at kinks.
  Vec2 point(double place, int run) const;
  /// (dr, dz) per u.
  Vec2 derivative(double place, int run) const;
  int num_runs() const { return static_cast<int>(runs_.size()); }

 private:
  struct Run {
    int first, end;             // pieces
    double bed_start, bed_end;  // rows
    std::vector<double> sizes;  // of its pieces, m
    double size;                // m
  };
  /// The piece at a place, and t; at the end of a piece t = 1.
  std::pair<int, double> piece_at(double place, int run) const;
  double size(int piece, double from, double to) const;
  double inverse(int piece, double target, double whole) const;
  double place_in(const Run& run, double share) const;

  std::vector<ProfilePiece> pieces_;
  VaultSurface::Courses by_;
  std::vector<Run> runs_;
  std::vector<double> places_;  // of whole beds
};

}  // namespace cupola
