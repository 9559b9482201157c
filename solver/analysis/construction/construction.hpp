#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "solver/analysis/construction/stage_problem.hpp"
#include "solver/analysis/statics/limit_search.hpp"

namespace cupola {

/// A structure that is built stage by stage. Displacements are small: equilibrium is that of the geometry as
/// designed, whose contacts are detected once, and each stage adds its displacements to gaps and elastic
/// slips. A block is laid stress-free where the structure then is: the gaps of its joints are those of the
/// design, whatever their neighbours moved before. Ties act likewise from where their second end is laid.
/// Supports move when the structure is complete. Without analysis.staged.carry every stage starts from the
/// state as designed.
class Construction {
 public:
  Construction(const Case& scene, const Assembly& assembly,
               const std::function<void(const std::string&)>& log);

  /// Lays blocks; from now on `ring` is the youngest course, and older mortar has hardened accordingly.
  void lay(const std::vector<int>& blocks, int ring);

  /// Static solve of what is laid. Need::verdict: if the blocks laid since the last equilibrium are proven to
  /// fall while the others rest, so does the whole, and their motion is the answer.
  enum class Need { forces, verdict };
  StaticSolution solve(Need need);
  /// With a value of the fresh property that analysis.staged.least names.
  StaticSolution solve(double trial);
  /// With the least value of that bracket with which it stands to analysis.tolerance, which verdicts need not
  /// meet.
  StaticSolution solve_least(const Bracket& bracket);
  /// Takes what is laid as standing, as solve() found it last, and continues from there if
  /// analysis.staged.carry.
  void accept(const StaticSolution& solution);
  /// Takes what is laid as standing, though no solve has shown it.
  void suppose_standing() { state_.fresh.clear(); }

  const BuildingSite& site() const { return *site_; }
  const StageProblem& problem() const { return problem_; }  ///< of the last solve
  const StaticOptions& options() const { return options_; }
  const BuiltState& state() const { return state_; }
  void log_to(const std::function<void(const std::string&)>& log) { options_.log = log; }
  /// Throws std::runtime_error if the state does not fit the assembly.
  void restore(BuiltState state);
  bool any_free() const;

 private:
  StaticSolution solve(const std::optional<double>& trial, Need need);
  std::optional<StaticSolution> falling_part(const std::optional<double>& trial,
                                             const StaticOptions& options);
  std::optional<NearbyStart> last_equilibrium() const;
  void harden(const Model& before, const Model& after);
  void place_beside_neighbours(const std::vector<int>& blocks);
  void move_supports();

  std::shared_ptr<const BuildingSite> site_;
  StaticOptions options_;
  BuiltState state_;
  StageProblem problem_;
};

}  // namespace cupola
