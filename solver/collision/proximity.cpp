#include "solver/collision/proximity.hpp"

#include <algorithm>
#include <numeric>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// FCL has no bare boxes in its tree. An unrotated fcl::Box keeps its bounding box exactly.
void set_box(const Box& box, fcl::Boxd* shape, fcl::CollisionObjectd* object) {
  shape->side = box.sizes();
  shape->computeLocalAABB();
  object->setTranslation(box.center());
  object->computeAABB();
}

struct PartnerCollector {
  std::span<const int> groups;
  int of = 0;
  std::vector<int> partners;
};

int index_of(const fcl::CollisionObjectd* object) {
  return *static_cast<const int*>(object->getUserData());
}

bool collect_partner(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  auto* collector = static_cast<PartnerCollector*>(data);
  const int j = index_of(a) == collector->of ? index_of(b) : index_of(a);
  if (j > collector->of && collector->groups[j] != collector->groups[collector->of])
    collector->partners.push_back(j);
  return false;  // continue
}

}  // namespace

struct BroadPhase::Tree {
  std::vector<int> groups;
  std::vector<int> indices;  ///< 0, 1, 2, ...: the user data of the objects point here
  std::vector<std::shared_ptr<fcl::Boxd>> shapes;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
  fcl::DynamicAABBTreeCollisionManagerd manager;
};

BroadPhase::BroadPhase(std::span<const Box> boxes, std::span<const int> groups)
    : tree_(std::make_unique<Tree>()) {
  CUPOLA_ASSERT(boxes.size() == groups.size());
  tree_->groups.assign(groups.begin(), groups.end());
  tree_->indices.resize(boxes.size());
  std::iota(tree_->indices.begin(), tree_->indices.end(), 0);
  std::vector<fcl::CollisionObjectd*> registered;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    tree_->shapes.push_back(std::make_shared<fcl::Boxd>());
    tree_->objects.push_back(std::make_unique<fcl::CollisionObjectd>(tree_->shapes.back()));
    set_box(boxes[i], tree_->shapes.back().get(), tree_->objects.back().get());
    tree_->objects.back()->setUserData(&tree_->indices[i]);
    registered.push_back(tree_->objects.back().get());
  }
  tree_->manager.registerObjects(registered);
  tree_->manager.setup();
}

BroadPhase::~BroadPhase() = default;
BroadPhase::BroadPhase(BroadPhase&&) noexcept = default;
BroadPhase& BroadPhase::operator=(BroadPhase&&) noexcept = default;

void BroadPhase::move(std::span<const int> indices, std::span<const Box> boxes) {
  CUPOLA_ASSERT(indices.size() == boxes.size());
  std::vector<fcl::CollisionObjectd*> moved;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const int i = indices[k];
    set_box(boxes[k], tree_->shapes[i].get(), tree_->objects[i].get());
    moved.push_back(tree_->objects[i].get());
  }
  if (!moved.empty()) tree_->manager.update(moved);
}

std::vector<int> BroadPhase::partners(int i) const {
  CUPOLA_ASSERT(i >= 0 && i < static_cast<int>(tree_->objects.size()));
  PartnerCollector collector{tree_->groups, i, {}};
  tree_->manager.collide(tree_->objects[i].get(), &collector, collect_partner);
  std::sort(collector.partners.begin(), collector.partners.end());
  return std::move(collector.partners);
}

struct ConvexBody::Shape {
  std::shared_ptr<fcl::Convexd> convex;
};

ConvexBody::ConvexBody(const Polytope& polytope) : shape_(std::make_unique<Shape>()) {
  auto vertices =
      std::make_shared<std::vector<fcl::Vector3d>>(polytope.vertices.begin(), polytope.vertices.end());
  auto faces = std::make_shared<std::vector<int>>();
  for (const std::vector<int>& face : polytope.faces) {
    faces->push_back(static_cast<int>(face.size()));
    faces->insert(faces->end(), face.begin(), face.end());
  }
  shape_->convex = std::make_shared<fcl::Convexd>(vertices, static_cast<int>(polytope.faces.size()), faces);
  shape_->convex->computeLocalAABB();
}

ConvexBody::~ConvexBody() = default;
ConvexBody::ConvexBody(ConvexBody&&) noexcept = default;
ConvexBody& ConvexBody::operator=(ConvexBody&&) noexcept = default;

std::optional<NearestPoints> ConvexBody::nearest_points(const ConvexBody& b,
                                                        const Eigen::Isometry3d& pose_ab) const {
  fcl::DistanceRequestd request;
  request.enable_nearest_points = true;
  request.enable_signed_distance = false;
  request.distance_tolerance = 1e-10;  // with the default 1e-6 some points are off by the size of a face
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::DistanceResultd result;
  const double distance = fcl::distance(shape_->convex.get(), fcl::Transform3d::Identity(),
                                        b.shape_->convex.get(), pose_ab, request, result);
  if (!(distance > 0.0)) return std::nullopt;
  return NearestPoints{result.nearest_points[0], result.nearest_points[1]};
}

}  // namespace cupola
