#pragma once

#include "assembly/model/results.hpp"
#include "solver/collision/contact_detector.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// The joints as built, whatever has become of them. Points whose faces have parted by more than the margin of
/// detection leave the contact problem, but not the frames: cracks and hinges are measured there.
class JointsAsBuilt {
 public:
  /// The model must outlive it.
  JointsAsBuilt(const Model& model, const DetectionOptions& detection);

  /// Adds to a frame, in the poses of `state`, the points that `found`, its contacts, no longer has because
  /// they have parted. They carry nothing.
  void list_parted(const State& state, const ContactSet& found, Frame* frame) const;

 private:
  const Model& model_;
  double margin_ = 0.0;  // m
  AnchoredContacts contacts_;
};

}  // namespace cupola
