#pragma once

#include <span>
#include <string>
#include <vector>

#include "assembly/model/assembly.hpp"
#include "assembly/model/loads.hpp"

namespace cupola {

/// A face of a free block on which a load acts.
struct LoadedFace {
  int block = 0, part = 0;
  std::vector<Vec3> polygon;     ///< m
  Vec3 centroid = Vec3::Zero();  ///< m
  Vec3 normal = Vec3::UnitZ();   ///< outward
  double area = 0.0;             ///< m2
};

constexpr double kUpright = 1e-9;  ///< cosine between a face and the vertical within rounding

LoadedFace loaded_face(const Assembly& assembly, int part, int f);

bool looks_up(const LoadedFace& face);

/// The part of a plane polygon with n.x <= offset; fewer than three points if there is none.
std::vector<Vec3> below_plane(const std::vector<Vec3>& polygon, const Vec3& n, double offset);

/// True if `name` in a case means this member: its own name, or that of which it is a copy or mirror image.
bool means_member(const std::string& name, const Assembly& assembly, int member);
/// The same for the member of a block; "" means all.
bool is_of_member(const Assembly& assembly, const Block& block, const std::string& name);

/// Faces of some kinds on the free blocks of a member ("": all), for parts in a range of rings, without what
/// other parts of the same block hide.
std::vector<LoadedFace> faces_of_kind(const Assembly& assembly, std::span<const FaceKind> kinds,
                                      int from_ring, int to_ring, const std::string& member);

/// Shares of a force that spreads from a rectangle down to the faces below it, along rays: the point (u, v) of
/// the rectangle, from -1/2 to 1/2 along each side, reaches u (x + 2 m d), v (y + 2 m d) at the depth d, with
/// the slope m. The share of a face is the part of the rectangle whose rays meet it, and the sum of all is one
/// where faces lie below the whole rectangle, less where some rays fall beside. Faces above each other do not
/// shade: a sum above one is scaled down to it.
struct SpreadShare {
  int block = 0;
  Vec3 point = Vec3::Zero();  ///< m
  double share = 0.0;
};
std::vector<SpreadShare> spread_shares(const Spread& spread, const Vec3& point,
                                       std::span<const LoadedFace> faces);

}  // namespace cupola
