#pragma once

#include "solver/analysis/statics/breaking_solve.hpp"
#include "solver/analysis/statics/limit_search.hpp"
#include "solver/analysis/statics/met_in_step.hpp"
#include "solver/analysis/statics/step_dissipation.hpp"

namespace cupola {

/// m, largest of a block.
double displacement_of(const StaticSolution& solution);

/// Sequence of equilibria of a structure whose loads and supports change slowly in time. Each step detects
/// the contacts anew and is a static solve from the last equilibrium; joints keep their slip, opening and
/// damage.
///
/// Each solve balances the forces in the geometry in which it starts, so that an equilibrium is off by the
/// displacement of its step; what hangs on ties hangs at rest there (hung_blocks.hpp). If blocks overlap at
/// its end that were too far apart at its start to make contacts, it is repeated with these
/// (met_in_step.hpp). A step has no equilibrium, and the path must take shorter ones, if blocks may have
/// passed each other, or if one by time moves a block by more than the size of the smallest.
///
/// With PathGeometry::end, and in steps by time that move a block by more than a hundredth of the smallest,
/// more solves follow, each from where the last one ended and at the same time, until one moves no block by
/// more than 1e-8 of the smallest, or 1e-5 where the imbalance that a solve leaves explains it: forces and
/// geometry then belong to each other. Where these solves move the blocks further than the step itself moved
/// blocks and supports, the structure may fall: the step has no equilibrium.
class EquilibriumPath {
 public:
  EquilibriumPath(const Model& model, const DetectionOptions& detection, const StaticOptions& options,
                  PathGeometry geometry = PathGeometry::start);

  /// Static solve at the time `value`. If it finds an equilibrium the path advances to it; otherwise it
  /// stays.
  StaticSolution advance(double value);
  /// The same by a displacement of the control, at a time that is found.
  StaticSolution advance_by(const LengthControl& control);
  /// True if the conic solver proves that no forces balance the loads at the time `value`. It takes a small
  /// part of the time in which a static solve comes to that verdict.
  bool surely_moves_at(double value);

  /// The last equilibrium and its contacts, as bytes from which a path of the same scene continues with the
  /// same bits. restore() throws std::runtime_error if they do not fit.
  std::string save() const;
  void restore(const std::string& bytes);

  double value() const { return loaded_.state.time; }
  const Model& model() const { return model_; }
  /// State at the start of the last step tried, and its contacts.
  const State& start() const { return start_; }
  /// The last equilibrium.
  const State& state() const { return loaded_.state; }
  const StaticOptions& options() const { return options_; }
  int solves() const { return solves_; }                      ///< static solves of the last step tried
  double dissipated() const { return dissipation_.total(); }  ///< J, in joints and ties in the last step
  const ContactSet& contacts() const { return contacts_; }
  const ContactMemories& memories() const { return memories_; }

 private:
  StaticSolution advance_from(double guess);
  void prepare(const LoadedState& from, double time_advance, const std::vector<double>& way = {});
  std::vector<double> reach(const ContactMemories& memories, const std::vector<double>& way = {}) const;
  std::vector<MetBlocks> met_at(const LoadedState& end, const std::vector<double>& way);
  StaticSolution solve_from(const LoadedState& from, double time_advance);
  bool is_unloaded() const;
  NearbyStart next_start(double step) const;
  /// Why the step from `last` leads so far that its linear geometry says nothing of its end; "" if it does not.
  std::string too_far(const LoadedState& last, const StaticSolution& solution) const;
  /// Solves again where the last solve ended, until forces and geometry belong to each other. `ties`: at the
  /// start of the step.
  StaticSolution correct(const std::vector<TieMemory>& ties, StaticSolution solution);
  double displacement_by_imbalance(const StaticSolution& solution) const;
  bool is_settled(const StaticSolution& solution) const;

  const Model& model_;
  StaticOptions options_;
  PathGeometry geometry_;
  ContactDetector detector_;
  LoadedState loaded_;
  VecX last_displacement_;  // of the last step, m, rad (6 nb), before corrections; empty: at rest as drawn
  double last_step_ = 0.0;  // its length: s, or m of the control
  State start_;
  ContactSet contacts_;
  StepDissipation dissipation_;
  ContactMemories memories_;
  int solves_ = 0;
};

/// The part of a path to follow, in the unit of its time: a spread factor, for example.
struct PathRange {
  double low = 0.0, high = 1.0;
  double longest_step = 1.0;  ///< > 0
};

/// Follows a path from `low`, at which the structure must stand, to `high`. The step is halved where no
/// equilibrium is found, until it is below relative_width times the value. `report` receives every trial and
/// returns false to abandon the search.
Bracket follow(EquilibriumPath* path, const PathRange& range, double relative_width,
               const std::function<bool(const LimitTrial&, const StaticSolution&)>& report);

}  // namespace cupola
