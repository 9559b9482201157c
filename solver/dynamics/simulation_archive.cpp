#include "assembly/files/byte_archive.hpp"
#include "solver/dynamics/simulation.hpp"
#include "solver/dynamics/state_archive.hpp"

namespace cupola {

// The fields that a checkpoint stores. Add any new field of these structs that persists from step to step.

template <class Archive>
void visit(Archive& archive, Energy& x) {
  archive(x.kinetic, x.potential, x.elastic);
}

template <class Archive>
void visit(Archive& archive, SleepState& x) {
  archive(x.calm_since, x.asleep);
}

std::string Simulation::save() const {
  State state = state_;
  DetectionMemory detection = detector_.memory();
  ContactMemories memories = memories_;
  SleepState sleep_state = sleep_state_;
  double next_h = next_h_, last_h = last_h_;
  Energy last_energy = energy_.value_or(energy());
  ByteWriter archive;
  archive(state, detection, memories, sleep_state, next_h, last_h, last_energy);
  return archive.bytes();
}

void Simulation::restore(const std::string& bytes) {
  DetectionMemory detection;
  State state;
  Energy last_energy;
  ByteReader archive(bytes);
  archive(state, detection, memories_, sleep_state_, next_h_, last_h_, last_energy);
  if (!archive.at_end() || state.poses.size() != state_.poses.size() || state.v.size() != state_.v.size())
    throw std::runtime_error("belongs to another scene");
  state_ = std::move(state);
  detector_.restore(std::move(detection));
  heat_contacts(state_.poses);
  detections_followed_ = 0;  // the islands are not stored: compute them again
  reduced_.reset();
  energy_ = last_energy;
}

}  // namespace cupola
