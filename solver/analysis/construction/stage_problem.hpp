#pragma once

#include <optional>
#include <vector>

#include "solver/collision/contact_set.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// What a contact of an unfinished structure carries from stage to stage.
struct BuiltContact {
  ContactMemory memory;   ///< impulse: force of the last stage, N
  double gap = 0.0;       ///< m, changes since both blocks are laid
  double hardened = 0.0;  ///< m, part of the gap that became its reference when the mortar hardened
};

/// What a tie carries from the stage in which both of its blocks are laid.
struct CarriedTie {
  TieMemory memory;        ///< impulse: tension of the last stage, N
  double loosening = 0.0;  ///< m, change of its gap since then
};

/// Blocks, joints and ties of an unfinished structure.
struct BuiltState {
  int ring = 0;                      ///< youngest course
  std::vector<char> laid;            ///< (num_blocks)
  std::vector<int> fresh;            ///< blocks laid since the last equilibrium
  std::vector<Vec3> displacement;    ///< m, of the centroids (num_blocks)
  std::vector<Vec3> rotation;        ///< rad (num_blocks)
  std::vector<BuiltContact> joints;  ///< by contact of the complete assembly (nc)
  std::vector<CarriedTie> ties;      ///< by tie of the complete model
  bool complete() const;             ///< all blocks are laid
};

/// What does not change while a structure is built.
struct BuildingSite {
  const Case& scene;
  const Assembly& assembly;
  std::vector<int> course;  ///< with which each block is laid, laying_courses()
  ContactSet contacts;      ///< of the complete assembly as designed

  BuildingSite(const Case& scene, const Assembly& assembly);
  /// A support, or a block so far below course `ring` that it counts as one.
  bool is_held(int block, int ring) const;
};

/// The part of a scene that one stage solves: blocks that are laid and not held, and the contacts and ties
/// that they have with each other and with held and fixed blocks.
struct StageProblem {
  Model model;
  ContactSet contacts;
  ContactMemories memories;
  State rest;             ///< as designed
  std::vector<int> rows;  ///< index of each contact in the complete assembly
  std::vector<int> ties;  ///< index of each tie in the complete model
  int num_blocks = 0;     ///< laid and not held, of all blocks of the stage
  double weight = 0.0;    ///< N, of these
};

/// Which blocks of a stage are free: all that are laid and not held, or, while the others rest, those laid
/// since the last equilibrium.
enum class FreeBlocks { all, fresh };

/// The complete scene with the mortar of a stage, whose free blocks are those that the stage solves. Loads
/// other than gravity act once the structure is complete. `trial`: value of the fresh property that
/// analysis.staged.least names.
Model stage_model(const BuildingSite& site, const BuiltState& state, const std::optional<double>& trial);

StageProblem stage_problem(const BuildingSite& site, const BuiltState& state,
                           const std::optional<double>& trial, FreeBlocks which);

}  // namespace cupola
