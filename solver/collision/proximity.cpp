#include "solver/collision/proximity.hpp"

#include <algorithm>
#include <cstdint>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

namespace cupola {
namespace {

/// FCL keeps the bounding box of an unrotated fcl::Box exactly: that is how a bare box enters its tree.
void set_box(const Box& box, fcl::Boxd* shape, fcl::CollisionObjectd* object) {
  shape->side = box.sizes();
  shape->computeLocalAABB();
  object->setTranslation(box.center());
  object->computeAABB();
}

struct PairCollector {
  std::span<const int> groups;
  std::vector<std::pair<int, int>> pairs;
};

int index_of(const fcl::CollisionObjectd* object) {
  return static_cast<int>(reinterpret_cast<std::intptr_t>(object->getUserData()));
}

bool collect_pair(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  auto* collector = static_cast<PairCollector*>(data);
  const int i = index_of(a);
  const int j = index_of(b);
  if (collector->groups[i] != collector->groups[j]) collector->pairs.emplace_back(std::minmax(i, j));
  return false;  // go on
}

}  // namespace

struct BroadPhase::Tree {
  std::vector<int> groups;
  std::vector<std::shared_ptr<fcl::Boxd>> shapes;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
  fcl::DynamicAABBTreeCollisionManagerd manager;
};

BroadPhase::BroadPhase(std::span<const Box> boxes, std::span<const int> groups)
    : tree_(std::make_unique<Tree>()) {
  tree_->groups.assign(groups.begin(), groups.end());
  std::vector<fcl::CollisionObjectd*> registered;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    tree_->shapes.push_back(std::make_shared<fcl::Boxd>());
    tree_->objects.push_back(std::make_unique<fcl::CollisionObjectd>(tree_->shapes.back()));
    set_box(boxes[i], tree_->shapes.back().get(), tree_->objects.back().get());
    tree_->objects.back()->setUserData(reinterpret_cast<void*>(static_cast<std::intptr_t>(i)));
    registered.push_back(tree_->objects.back().get());
  }
  tree_->manager.registerObjects(registered);
  tree_->manager.setup();
}

BroadPhase::~BroadPhase() = default;
BroadPhase::BroadPhase(BroadPhase&&) noexcept = default;
BroadPhase& BroadPhase::operator=(BroadPhase&&) noexcept = default;

void BroadPhase::move(std::span<const int> indices, std::span<const Box> boxes) {
  std::vector<fcl::CollisionObjectd*> moved;
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const int i = indices[k];
    set_box(boxes[k], tree_->shapes[i].get(), tree_->objects[i].get());
    moved.push_back(tree_->objects[i].get());
  }
  if (!moved.empty()) tree_->manager.update(moved);
}

std::vector<std::pair<int, int>> BroadPhase::overlapping_pairs() const {
  PairCollector collector{tree_->groups, {}};
  tree_->manager.collide(&collector, collect_pair);
  std::sort(collector.pairs.begin(), collector.pairs.end());
  return collector.pairs;
}

}  // namespace cupola
