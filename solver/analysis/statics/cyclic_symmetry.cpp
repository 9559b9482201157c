#include "solver/analysis/statics/cyclic_symmetry.hpp"

#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/statics/model_symmetry.hpp"

namespace cupola {
namespace {

/// Follows each element around its orbit. `next` is a permutation; `swapped` may be empty. `short_orbit` is
/// set to an element that returns to its place after fewer than `sectors` rotations.
std::vector<CyclicSymmetry::Image> orbits(const std::vector<int>& next, const std::vector<char>& swapped,
                                          int sectors, std::vector<int>* representatives, int* short_orbit) {
  CUPOLA_ASSERT(swapped.empty() || swapped.size() == next.size());
  std::vector<CyclicSymmetry::Image> images(next.size());
  std::vector<char> visited(next.size(), 0);
  for (int i = 0; i < static_cast<int>(next.size()); ++i) {
    if (visited[i]) continue;
    const int orbit = static_cast<int>(representatives->size());
    representatives->push_back(i);
    int k = i;
    bool swap = false;
    for (int turns = 0; turns < sectors; ++turns) {
      if (visited[k]) {
        *short_orbit = k;
        return images;
      }
      visited[k] = 1;
      images[k] = {orbit, turns, swap};
      if (!swapped.empty()) swap = swap != (swapped[k] != 0);
      k = next[k];
    }
    if (k != i) *short_orbit = k;
  }
  return images;
}

CyclicSymmetry orbits_of(const ModelSymmetry& turn, int sectors, const Model& model,
                         const ContactSet& contacts) {
  CyclicSymmetry symmetry;
  symmetry.sectors = sectors;
  int short_orbit = -1;
  symmetry.blocks = orbits(turn.blocks, {}, sectors, &symmetry.block_of_orbit, &short_orbit);
  if (short_orbit >= 0)
    throw NotSymmetric(
        fmt::format("block {} returns to its place before a full turn", model.free_blocks[short_orbit]));
  symmetry.contacts = orbits(turn.contacts, turn.swapped, sectors, &symmetry.contact_of_orbit, &short_orbit);
  if (short_orbit >= 0)
    throw NotSymmetric(
        fmt::format("the contact between blocks {} and {} returns to its place before a full turn",
                    contacts.points[short_orbit].block_a, contacts.points[short_orbit].block_b));
  return symmetry;
}

}  // namespace

Mat3 CyclicSymmetry::rotation(int turns) const {
  return Eigen::AngleAxisd(2.0 * std::numbers::pi * turns / sectors, Vec3::UnitZ()).toRotationMatrix();
}

CyclicSymmetry find_cyclic_symmetry(const Model& model, const State& start, const ContactSet& contacts,
                                    int sectors) {
  const Mat3 turn = Eigen::AngleAxisd(2.0 * std::numbers::pi / sectors, Vec3::UnitZ()).toRotationMatrix();
  try {
    return orbits_of(find_symmetry(model, start, contacts, turn, Vec3::Zero()), sectors, model, contacts);
  } catch (const NotSymmetric& e) {
    throw InputError(fmt::format("analysis.cyclic_sectors = {}: the model does not have this symmetry: {}",
                                 sectors, e.what()));
  }
}

}  // namespace cupola
