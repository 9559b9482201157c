#pragma once

#include <optional>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "assembly/base/named_enum.hpp"
#include "assembly/model/block_ref.hpp"

namespace cupola {

/// Blocks that rest on supports: those of the ribs of an octagonal vault, those nearest the middle of each
/// sail, herringbone blocks, or the blocks listed.
struct BaseBlocks {
  enum class Group { ribs, mid_sails, herringbone, listed };
  Group group = Group::listed;
  std::vector<BlockRef> blocks;
};
constexpr auto enum_names(BaseBlocks::Group) {
  return std::array{"ribs", "mid_sails", "herringbone", "listed"};
}

/// Horizontal outward force on the supports: the sum over the base of a vault, the force at one springing of
/// an arch.
struct BaseThrust {};

/// Force of a block on the supports below it, or of all blocks on a support.
struct BlockReaction {
  enum class Component { vertical, outward };
  BlockRef block;
  Component component = Component::vertical;  ///< downwards; horizontally away from the axis
  std::optional<Eigen::Vector3d> direction;   ///< instead of `component`; of any length
};
constexpr auto enum_names(BlockReaction::Component) {
  return std::array{"vertical", "outward"};
}

/// Force in the joint of two blocks, all its faces together. With n its mean normal from block_a to block_b
/// and F the force on block_b: `normal` F . n; `shear` F . d and `eccentricity`, the distance along d of the
/// pressure point from the centroid of the joint, with d the part of `direction` in the plane of the joint;
/// `resultant` F . direction.
struct JointForce {
  enum class Component { normal, shear, resultant, eccentricity };
  BlockRef block_a, block_b;
  Component component = Component::normal;
  /// Of any length. None: outwards from the axis of a vault, in the plane of an arch.
  std::optional<Eigen::Vector3d> direction;
};
constexpr auto enum_names(JointForce::Component) {
  return std::array{"normal", "shear", "resultant", "eccentricity"};
}

/// Hoop force of the blocks whose first course is `ring`, mean over all meridian cuts, through joints and
/// blocks, compression positive. By virtual work with the displacement e_r it is -(1 / 2 pi) times the sum of
/// the radial forces that act on these blocks from outside, each at its point; loads act at the centroids.
struct HoopForce {
  int ring = 0;
};

/// Vertical force of a group of blocks on the supports over that of all blocks.
struct BaseShare {
  BaseBlocks of;
};

/// Mean vertical force per block of one group on the supports over that of another.
struct BaseRatio {
  BaseBlocks of, over;
};

/// Force of a tie, >= 0, or of a rod, tension positive: `tie` is a number in the tables of ties, in which a
/// rod is a tie and a strut and has two.
struct TieForce {
  int tie = 0;
};

/// Force of a restraint on its block along the direction of the restraint.
struct RestraintForce {
  int restraint = 0;  ///< index into Supports::restraints
};

/// The normal force of every joint whose centroid lies within the first of a number of equal sectors about
/// the axis. In an analysis of one sector (`analysis.cyclic_sectors`): the mean over the joint and its images
/// about the axis.
struct AllJoints {
  int sectors = 1;
};

/// A quantity of which a range analysis finds the smallest and the largest value.
using ForceQuantity = std::variant<BaseThrust, BlockReaction, JointForce, HoopForce, BaseShare, BaseRatio,
                                   TieForce, RestraintForce, AllJoints>;

}  // namespace cupola
