#include "solver/analysis/admissible/joint_geometry.hpp"

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"

namespace cupola {
JointGeometry::JointGeometry(const Assembly& assembly, const ContactSet& contacts)
    : assembly_(assembly), thrust_(assembly) {
  std::map<std::pair<int, int>, double> areas;
  for (const Patch& patch : contacts.patches) {
    const std::pair key{patch.block_a, patch.block_b};
    BlockPair& pair = pairs_[key];
    areas[key] += patch.area;
    pair.centroid += patch.area * polygon_centroid(patch.polygon);
  }
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    const Contact& contact = contacts.points[i];
    BlockPair& pair = pairs_[{contact.block_a, contact.block_b}];
    pair.contacts.push_back(static_cast<int>(i));
    pair.normal += contact.area * contact.normal;
  }
  for (auto& [key, pair] : pairs_) {
    pair.normal.normalize();
    const auto area = areas.find(key);
    if (area != areas.end() && area->second > 0.0) {
      pair.centroid /= area->second;
    } else {  // edges and vertices
      pair.centroid.setZero();
      for (const int i : pair.contacts)
        pair.centroid += contacts.points[i].point_a / static_cast<double>(pair.contacts.size());
    }
  }
  std::erase_if(pairs_, [](const auto& entry) { return entry.second.contacts.empty(); });
}

const BlockPair& JointGeometry::pair(int block_a, int block_b) const {
  const auto found = pairs_.find(std::minmax(block_a, block_b));
  if (found != pairs_.end()) return found->second;
  std::vector<int> neighbours;
  for (const auto& [key, pair] : pairs_) {
    if (key.first == block_a) neighbours.push_back(key.second);
    if (key.second == block_a) neighbours.push_back(key.first);
  }
  const std::string first = block_label(assembly_, block_a);
  throw InputError(fmt::format(
      "analysis.range.quantities: blocks {} and {} have no closed joint; {}", first,
      block_label(assembly_, block_b),
      neighbours.empty() ? fmt::format("block {} touches none", first)
                         : fmt::format("block {} touches {}", first, block_labels(assembly_, neighbours))));
}

Vec3 JointGeometry::outward(const Vec3& point, int block) const {
  if (const Sheet* vault = assembly_.vault_of(assembly_.blocks[block].ring))
    return vault->outward(point).value();
  const bool imported = assembly_.sheets.empty();
  throw InputError(fmt::format(
      "analysis.range.quantities: {} no axis, so that `thrust` and `outward` are not defined; give "
      "a reaction or joint a `direction`",
      imported ? "give geometry.import.axis: these imported blocks have" : "a wall has"));
}

Vec3 JointGeometry::outward_on_support(const Vec3& point, int block) const {
  outward(point, block);  // refuses blocks without an axis
  return thrust_.outward(assembly_.blocks[block].ring, point);
}

}  // namespace cupola
