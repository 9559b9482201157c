#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "assembly/base/error.hpp"
#include "assembly/model/assembly.hpp"
#include "assembly/model/joint_rule.hpp"

namespace cupola {

/// A joint below the least width (see JointRule), between blocks without any other joint.
struct NarrowJoint {
  int block_a = 0, block_b = 0;
  double width = 0.0;  ///< m
};

/// Stones of the first course of a vault on several springers, with joints between them, under which is
/// nothing.
struct HangingCorner {
  int block = 0;  ///< the first of them
  Vec3 centroid;  ///< m, of that block
  std::string member;
};

/// Faces of two parts of different blocks that form a joint.
struct FacePair {
  int part_a = 0, part_b = 0;
  int face_a = 0, face_b = 0;  ///< of the assembly
};

/// Measurements of a model. Lengths in m, volumes in m3.
struct ModelReport {
  int num_blocks = 0;  ///< without supports
  int num_supports = 0;
  int num_parts = 0;          ///< without supports
  int num_joints = 0;         ///< pairs of blocks that share a face patch, with supports
  double volume = 0.0;        ///< sum over the blocks without supports
  double parts_volume = 0.0;  ///< sum over their parts
  double smallest_block = 0.0, largest_block = 0.0;
  std::optional<double> shell_volume;  ///< of the smooth shell; none for stages and imported blocks
  double max_convexity_error = 0.0;    ///< largest height of a vertex above a face plane of its part
  double max_planarity_error = 0.0;    ///< largest distance of a vertex from the plane of its face
  double max_overlap = 0.0;            ///< largest overlap of parts of two blocks; <= 0 if none overlap
  double max_joint_gap = 0.0;          ///< largest distance between the planes of two faces in a joint
  double shortest_edge = 0.0;
  int islands = 0;                              ///< connected components of the graph of joints and ties
  std::vector<int> blocks_without_joint;        ///< without tie and without contact at an edge or a corner
  int blocks_on_edges = 0;                      ///< free ones that touch others at edges or corners only
  std::optional<int> floating;                  ///< first block of an island without a support
  std::set<std::pair<int, int>> joined_sheets;  ///< with joints between their free blocks, lower number first
  std::vector<char> is_borne;  ///< by ring: a block has a joint with a support or another sheet
  std::vector<HangingCorner> hanging_corners;
  std::vector<NarrowJoint> narrow_joints;  ///< ignored by contact detection
  std::vector<FacePair> joint_faces;       ///< one pair per two parts that meet; only if checked part by part
};

/// Name and source of an imported block, for messages. Generated blocks are named by their number.
struct BlockOrigin {
  std::string name;
  FileLocation where;
};

/// Bounds that a model must keep.
struct ModelTolerances {
  double plane = 0.0;         ///< m, for convexity and planarity
  double overlap = 0.0;       ///< m, for the overlap of two blocks
  double joint_gap = 0.0;     ///< m, largest distance of two faces that form a joint
  double joint_width = 0.0;   ///< m, least width of the overlap of two faces that form a joint
  double joint_angle = 0.0;   ///< rad, largest angle between two faces that form a joint
  bool part_by_part = false;  ///< parts share no vertices, so each must be closed by itself
};

/// For generated blocks: 1e-13 of the model's size for planes (rounding of the coordinates), and 2e-11 of it
/// for overlaps and gaps (1e-9 m for the 50 m dome).
ModelTolerances generated_tolerances(const Assembly& assembly);

/// For imported blocks: the rule of contact detection for overlaps and joints; planes within 1e-5 of the
/// model's size, or within `facet_angle` (rad) of it if that is larger.
ModelTolerances imported_tolerances(const Assembly& assembly, double facet_angle, const JointRule& rule);

/// Measures a model and checks that blocks are closed, oriented outwards and free of self-intersections
/// (CGAL, exact predicates), that parts are convex with plane faces, and that no two blocks overlap. Throws
/// InputError with the block and the number that exceeds its bound. `origins` has one entry per block, or is
/// empty.
ModelReport check_model(const Assembly& assembly, const ModelTolerances& tolerances,
                        std::span<const BlockOrigin> origins = {});

std::string to_text(const ModelReport& report);

/// What the user must know about the blocks, one sentence each.
std::vector<std::string> warnings_of(const ModelReport& report, std::span<const BlockOrigin> origins = {});

}  // namespace cupola
