#include "solver/analysis/admissible/range_images.hpp"

#include <map>

namespace cupola {
namespace {

/// The contact that tells a joint from others: the first one in its normal force. None for other objectives.
std::optional<int> contact_of(const RangeObjective& objective) {
  if (!objective.joint || objective.over || objective.mean_of_images) return std::nullopt;
  return objective.value.contacts.begin()->first;
}

}  // namespace

RangeImages::RangeImages(const RigidScene& scene, const std::vector<RangeObjective>& objectives)
    : scene_(scene), objectives_(objectives) {
  std::map<std::pair<int, int>, int> of_joint;
  for (int i = 0; i < static_cast<int>(objectives.size()); ++i) {
    images_.push_back({i});
    if (contact_of(objectives[i])) of_joint.emplace(*objectives[i].joint, i);
  }
  if (of_joint.size() < 2) return;
  symmetries_ = find_symmetries(scene.model, scene.start, scene.contacts);
  for (int i = 0; i < static_cast<int>(objectives.size()); ++i) {
    const std::optional<int> contact = contact_of(objectives[i]);
    if (!contact || images_[i].symmetry >= 0) continue;
    for (int k = 0; k < static_cast<int>(symmetries_.size()); ++k) {
      const Contact& image = scene.contacts.points[symmetries_[k].contacts[*contact]];
      const auto found = of_joint.find(std::minmax(image.block_a, image.block_b));
      if (found == of_joint.end() || found->second <= i || images_[found->second].symmetry >= 0) continue;
      images_[found->second] = {i, k};
      images_[i].of_others = true;
    }
  }
}

std::optional<RangeSolution> RangeImages::end(int objective, double towards,
                                              const RangeSolution& of_original) const {
  const ModelSymmetry& symmetry = symmetries_[images_[objective].symmetry];
  return range_end_of(scene_, objectives_[objective], towards,
                      symmetry.forces(scene_.problem.contacts, of_original.gamma),
                      symmetry.velocities(of_original.v));
}

}  // namespace cupola
