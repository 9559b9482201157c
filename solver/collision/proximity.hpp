#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "solver/collision/inset.hpp"

namespace cupola {

using Box = Eigen::AlignedBox3d;

/// Finds the pairs of overlapping boxes among many, in a dynamic tree of axis-aligned boxes (FCL).
class BroadPhase {
 public:
  /// Boxes of one group are never paired. One group per box (see collision_groups()).
  BroadPhase(std::span<const Box> boxes, std::span<const int> groups);
  ~BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;

  /// Replaces the boxes of the given indices.
  void move(std::span<const int> indices, std::span<const Box> boxes);

  /// Indices > i of the boxes that overlap box i, sorted. Thread-safe. There is no list of all pairs, because
  /// each axis-aligned box of a slender, inclined brick overlaps thousands of others.
  std::vector<int> partners(int i) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// Nearest points of two separate convex bodies. Coordinates in m, axes of the first.
struct NearestPoints {
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();
};

/// A convex body for distance queries by GJK (FCL on libccd).
class ConvexBody {
 public:
  explicit ConvexBody(const Polytope& polytope);
  ~ConvexBody();
  ConvexBody(ConvexBody&&) noexcept;
  ConvexBody& operator=(ConvexBody&&) noexcept;

  /// `pose_ab` transforms coordinates of b to those of this body. Returns nothing when the bodies touch or
  /// overlap, where FCL's signed distance would abort the process. Accuracy: 1e-10 of the size of the bodies.
  std::optional<NearestPoints> nearest_points(const ConvexBody& b, const Eigen::Isometry3d& pose_ab) const;

 private:
  struct Shape;
  std::unique_ptr<Shape> shape_;
};

}  // namespace cupola
