#include "solver/analysis/record/joints_as_built.hpp"

#include "solver/analysis/record/record.hpp"

namespace cupola {

JointsAsBuilt::JointsAsBuilt(const Model& model, const DetectionOptions& detection) : model_(model) {
  ContactDetector detector(*model.assembly, detection);
  contacts_at_rest(model, &detector);
  margin_ = detector.margin();
  contacts_ = detector.memory().contacts;
}

void JointsAsBuilt::list_parted(const State& state, const ContactSet& found, Frame* frame) const {
  AnchoredContacts now = contacts_;
  move_contacts(state.poses, moved_contacts(now.set, std::vector<char>(state.poses.size(), 1)), &now);
  if (!model_.heat.empty()) now.set = model_.heat.heated(std::move(now.set), state.poses, state.time);
  append_parted(model_, now.set, found, margin_, frame);
}

}  // namespace cupola
