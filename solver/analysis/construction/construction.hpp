#pragma once

#include <optional>
#include <vector>

#include "solver/analysis/statics/static_solve.hpp"
#include "solver/collision/contact_set.hpp"
#include "solver/dynamics/laying_order.hpp"

namespace cupola {

/// What a contact of an unfinished structure carries from stage to stage.
struct BuiltContact {
  ContactMemory memory;   ///< impulse: force of the last stage, N
  double gap = 0.0;       ///< m, changes since both blocks are laid
  double hardened = 0.0;  ///< m, part of the gap that became its reference when the mortar hardened
};

/// Blocks and joints of an unfinished structure.
struct BuiltState {
  std::vector<char> laid;            ///< (num_blocks)
  std::vector<Vec3> displacement;    ///< m, of the centroids (num_blocks)
  std::vector<Vec3> rotation;        ///< rad (num_blocks)
  std::vector<BuiltContact> joints;  ///< by contact of the complete assembly (nc)
};

/// The part of a scene that one stage solves: blocks that are laid and not held, and the contacts that they
/// have with each other and with held and fixed blocks.
struct StageProblem {
  Model model;
  ContactSet contacts;
  ContactMemories memories;
  State rest;             ///< as designed
  std::vector<int> rows;  ///< index of each contact in the complete assembly
};

/// A structure that is built stage by stage. Displacements are small: equilibrium is that of the geometry as
/// designed, whose contacts are detected once, and each stage adds its displacements to gaps and elastic
/// slips. A block is laid stress-free where the structure then is: the gaps of its joints are those of the
/// design, whatever their neighbours moved before. Without analysis.staged.carry every stage starts from the
/// state as designed.
class Construction {
 public:
  Construction(const Case& scene, const Assembly& assembly,
               const std::function<void(const std::string&)>& log);

  /// Lays blocks; from now on `ring` is the youngest course, and older mortar has hardened accordingly.
  void lay(const std::vector<int>& blocks, int ring);

  /// Static solve of what is laid. `trial`: value of the fresh property that analysis.staged.least names, for
  /// a verdict only.
  StaticSolution solve(std::optional<double> trial = std::nullopt);
  /// Continues from the equilibrium that solve() found last, if analysis.staged.carry.
  void accept(const StaticSolution& solution);

  /// Of the last solve, before accept(), with all blocks of the assembly.
  Frame frame(const StaticSolution& solution) const;
  const StageProblem& problem() const { return problem_; }
  const StaticOptions& options() const { return options_; }
  const BuiltState& state() const { return state_; }
  void restore(BuiltState state, int ring);
  /// m: by which the most compressed fresh head joint has closed since it was laid, in the equilibrium of the
  /// last solve.
  double head_squeeze(const StaticSolution& solution) const;
  /// m: largest displacement of a block since it was laid, in the equilibrium of the last solve.
  double displacement(const StaticSolution& solution) const;
  /// The contact of the last solve with the largest violation of its law, if that exceeds `worst`.
  std::optional<LawViolation> violation_above(const std::optional<LawViolation>& worst,
                                              const StaticSolution& solution, double time) const;
  bool any_free() const;

 private:
  Model model_at(std::optional<double> trial) const;
  bool is_held(int block) const;
  bool is_complete() const;
  void build_problem(std::optional<double> trial);
  std::optional<std::vector<int>> new_blocks() const;
  void harden(const Model& before, const Model& after);

  const Case& scene_;
  const Assembly& assembly_;
  StaticOptions options_;
  ContactSet complete_;  ///< contacts of the complete assembly as designed
  BuiltState state_;
  int ring_ = 0;          ///< youngest course
  std::vector<int> new_;  ///< blocks laid since the last equilibrium
  StageProblem problem_;
};

}  // namespace cupola
