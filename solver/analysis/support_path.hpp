#pragma once

#include <optional>

#include "solver/analysis/limit_search.hpp"

namespace cupola {

/// A structure followed through equilibria while its supports move slowly: the clock is the factor on the
/// support moves, each step is a static solve from the last equilibrium with contacts found again.
class SupportPath {
 public:
  SupportPath(const Model& model, const DetectionOptions& detection, const StaticOptions& options);

  /// Tries to go on to `value`. Where an equilibrium is found it is taken over; else the path stays.
  StaticSolution advance(double value);

  double value() const { return loaded_.state.time; }
  const Model& model() const { return model_; }
  /// Start of the last step tried, and the contacts there.
  const State& start() const { return start_; }
  const ContactSet& contacts() const { return detector_.contacts(); }
  const ContactMemories& memories() const { return memories_; }

 private:
  const Model& model_;
  StaticOptions options_;
  ContactDetector detector_;
  LoadedState loaded_;
  State start_;
  ContactMemories memories_;
};

/// Follows a path from `low` (where it must stand) to `high`, halving the step where nothing holds, until the
/// step is below relative_width times the value. `report` sees every trial.
Bracket follow(SupportPath* path, double low, double high, double relative_width,
               const std::function<bool(const LimitTrial&, const StaticSolution&)>& report);

}  // namespace cupola
