#pragma once

#include <limits>
#include <optional>
#include <string>

namespace cupola {

/// The accuracy that decides whether a run has converged: the error of one quantity in one norm. Errors that
/// were not measured are NaN.
struct Accuracy {
  std::string quantity;  ///< what is in error, as a noun phrase: "force balance of the blocks"
  std::string norm;      ///< how: "largest unbalanced force of a block, relative to ..."
  double asked = 0.0;    ///< error requested
  double reached = std::numeric_limits<double>::quiet_NaN();         ///< of the state that the results show
  double worst_over_run = std::numeric_limits<double>::quiet_NaN();  ///< largest of all steps or stages
};

/// Upper bound of the error of the forces that requires no reference solution.
struct ForceCertificate {
  std::optional<double> value;
  /// What `value` bounds and in which norm, as a noun phrase: "the distance of ... from ..., in the norm of
  /// ...". Without a value: why nothing is certified, as a clause.
  std::string bounds;
};

/// Whether the model determines its forces uniquely.
struct ForcesUnique {
  /// The reason where a conic solver ended at one of many states, which no compliance chose.
  static constexpr const char* kOneOfMany = "they are one of the admissible states";

  bool value = true;
  std::string reason;  ///< a clause
};

/// Where the contact law is violated most.
struct LawViolation {
  double value = 0.0;  ///< error of a contact's force, relative to the force of its joint
  int joint = -1;      ///< in the frame at this time; -1 without contacts
  int block_a = -1, block_b = -1;
  double time = 0.0;  ///< s
};

/// A step of a motion: its number, from 1, and the time at its end.
struct RunStep {
  int step = 0;
  double time = 0.0;  ///< s
};

/// The steps of a motion in which its accuracy was worst. A number that no step has is absent.
struct WorstSteps {
  std::optional<RunStep> momentum_residual, contact_law_residual, certified_force_error;
};

/// Sentences for the user, generated from the values.
std::string to_sentence(const Accuracy& accuracy);
std::string to_sentence(const ForceCertificate& certificate);
std::string to_sentence(const ForcesUnique& unique);

}  // namespace cupola
