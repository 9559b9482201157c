#pragma once

#include <array>
#include <map>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// A convex polyhedron over the vertices of an assembly, with faces as in Assembly.
struct ConvexPiece {
  struct Face {
    std::vector<int> vertices;  // counter-clockwise seen from outside
    FaceKind kind = FaceKind::free;
    int plane = -1;  ///< of the body that cut it, or -1
  };
  std::vector<Face> faces;
};

ConvexPiece piece_of(const Assembly& assembly, const Part& part);
std::vector<Vec3> points_of(const Assembly& assembly, const ConvexPiece::Face& face);
double volume_of(const Assembly& assembly, const ConvexPiece& piece);  ///< m3

/// m, least width of the widest patch that two pieces share; 0 if they do not meet. Across a gap their planes
/// are apart and a little inclined to each other.
double shared_width(const Assembly& assembly, const ConvexPiece& a, const ConvexPiece& b, double rounding,
                    double gap = 0.0);

/// Cuts convex pieces by the planes of one convex body. Neighbouring pieces share their edges, and so the
/// vertices in which a plane meets them: joints stay closed. Vertices nearer to a plane than `rounding` (m)
/// lie on it.
class ConvexClip {
 public:
  /// The body: n.x <= offset for all its planes.
  ConvexClip(std::vector<Plane> body, double rounding, Assembly* assembly);

  /// The part of a piece outside the body, as convex pieces; the piece itself if they do not overlap.
  std::vector<ConvexPiece> outside(const ConvexPiece& piece);
  /// The part inside the body; no faces if there is none.
  ConvexPiece inside(const ConvexPiece& piece);

 private:
  /// The part with n.x <= offset, or with n.x >= offset; no faces if there is none.
  ConvexPiece half(const ConvexPiece& piece, int plane, bool below);
  double height(int vertex, int plane) const;
  /// The vertex where a plane meets an edge.
  int meeting(int a, int b, int plane);

  std::vector<Plane> body_;
  double rounding_;
  Assembly* assembly_;
  std::map<std::array<int, 3>, int> meetings_;
};

}  // namespace cupola
