#pragma once

#include <optional>

#include "assembly/records/summary_record.hpp"
#include "solver/analysis/record/record.hpp"

namespace cupola {

// The accuracy of the steps so far, for checkpoints.

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

template <class Archive, Record R>
void visit(Archive& archive, R& x) {
  fields([&archive](const char*, const char*, const char*, auto& member) { archive(member); }, x);
}

template <class Archive>
void visit(Archive& archive, WorstOfRun& x) {
  Residuals& r = x.residuals;
  archive(r.momentum, r.contact_law, r.rigid_contact_speed, r.contact_law_rounding, r.cone_violation);
  archive(x.certificate, x.unique, x.violation, x.steps);
}

}  // namespace cupola
