#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "solver/analysis/record/record.hpp"

namespace cupola {

// The accuracy of the steps so far, for checkpoints.

template <class Archive>
void visit(Archive& archive, ForceCertificate& x) {
  double value = x.value.value_or(std::numeric_limits<double>::quiet_NaN());
  archive(value, x.bounds);
  if (std::isnan(value))
    x.value.reset();
  else
    x.value = value;
}

template <class Archive>
void visit(Archive& archive, LawViolation& x) {
  archive(x.value, x.joint, x.block_a, x.block_b, x.time);
}

template <class Archive, class T>
void visit(Archive& archive, std::optional<T>& x) {
  bool set = x.has_value();
  T value = x.value_or(T{});
  archive(set, value);
  if (set)
    x = value;
  else
    x.reset();
}

template <class Archive>
void visit(Archive& archive, RunStep& x) {
  archive(x.step, x.time);
}

template <class Archive>
void visit(Archive& archive, WorstSteps& x) {
  archive(x.momentum_residual, x.contact_law_residual, x.certified_force_error);
}

template <class Archive>
void visit(Archive& archive, WorstOfRun& x) {
  Residuals& r = x.residuals;
  archive(r.momentum, r.contact_law, r.rigid_contact_speed, r.contact_law_rounding, r.cone_violation);
  archive(x.certificate, x.unique.value, x.unique.reason, x.violation, x.steps);
}

}  // namespace cupola
