#include "assembly/model/thrust_joint.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cupola {

namespace {

/// True if a stone is a springer of a vault, or the last of an arch: one beside it springs from the same
/// bearer.
bool springs(const Assembly& assembly, const Block& block) {
  const Sheet* vault = assembly.vault_of(block.ring);
  if (!vault) return false;
  const bool is_last = block.ring + block.num_rings == vault->first_ring + vault->num_rings;
  return block.ring == vault->first_ring || (is_last && vault->thrust_lines == Sheet::ThrustLines::one);
}

/// True if `upper` stands or leans on `lower` by a joint with this normal of either sign. By a level normal it
/// does so unless heads meet, or both are springers.
bool bears(const Assembly& assembly, int lower, int upper, JointKind kind, const Vec3& normal) {
  constexpr double kLevel = 1e-6;
  const bool upwards = normal.dot(assembly.blocks[upper].centroid - assembly.blocks[lower].centroid) >= 0.0;
  const double rise = upwards ? normal.z() : -normal.z();
  return rise > kLevel ||
         (rise >= -kLevel && kind != JointKind::head && !springs(assembly, assembly.blocks[lower]));
}

/// By sheet, m: halfway between the ends of the stones of an arch along x in its own frame; 0 of others.
std::vector<double> middles_of(const Assembly& assembly) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, double>> ends(assembly.sheets.size(), {kFar, -kFar});
  const Sheet* of_all =
      assembly.num_rings == 0 && !assembly.sheets.empty() ? assembly.sheets.data() : nullptr;
  for (const Part& part : assembly.parts) {
    const Sheet* sheet = of_all ? of_all : assembly.sheet_of(part.ring);
    if (assembly.blocks[part.block].fixed || !sheet || sheet->thrust_lines != Sheet::ThrustLines::one)
      continue;
    auto& [low, high] = ends[sheet - assembly.sheets.data()];
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const int v : assembly.face(f)) {
        const double x = sheet->own(assembly.vertices[v]).x();
        low = std::min(low, x);
        high = std::max(high, x);
      }
  }
  std::vector<double> middles;
  for (const auto& [low, high] : ends) middles.push_back(low <= high ? 0.5 * (low + high) : 0.0);
  return middles;
}

}  // namespace

std::vector<const Sheet*> pushing_sheets(const Assembly& assembly) {
  std::vector<const Sheet*> pushing;
  int last = -1;  // first course of the stack found last
  for (size_t i = assembly.sheets.size(); i-- > 0;) {
    const Sheet& sheet = assembly.sheets[i];
    const int first = assembly.stack_of(sheet.first_ring).first;
    if (sheet.thrust_lines == Sheet::ThrustLines::none || first == last) continue;
    pushing.push_back(&sheet);
    last = first;
  }
  return pushing;
}

ThrustJoints::ThrustJoints(const Assembly& assembly) : assembly_(assembly), middles_(middles_of(assembly)) {}

Vec3 ThrustJoints::outward(const Sheet& sheet, const Vec3& point) const {
  const double middle = middles_[&sheet - assembly_.sheets.data()];
  return sheet.outward(point - middle * sheet.towards(0.0)).value();
}

Vec3 ThrustJoints::outward(int ring, const Vec3& point) const {
  const Sheet* vault = assembly_.vault_of(ring);
  return vault ? outward(*vault, point) : assembly_.outward(ring, point);
}

bool ThrustJoints::is_at_far_side(const Sheet& sheet, const Vec3& point) const {
  return sheet.thrust_lines == Sheet::ThrustLines::one && outward(sheet, point).dot(sheet.towards(0.0)) < 0.0;
}

int ThrustJoints::bearer(const Sheet& sheet, const Joint& joint, const Vec3& centroid,
                         const Vec3& normal) const {
  const auto [first, end] = assembly_.stack_of(sheet.first_ring);
  const auto course = [this](int block) {
    return assembly_.blocks[block].fixed ? -1 : std::max(assembly_.blocks[block].ring, 0);
  };
  const auto [lower, upper] = course(joint.block_a) < course(joint.block_b)
                                  ? std::pair(joint.block_a, joint.block_b)
                                  : std::pair(joint.block_b, joint.block_a);
  if (course(upper) < first || course(upper) >= std::max(end, 1) || course(lower) >= first) return -1;
  if (assembly_.blocks[lower].fixed) return lower;
  const Block& block = assembly_.blocks[upper];
  const bool stands =
      is_at_far_side(sheet, centroid) ? block.ring + block.num_rings == end : block.ring == first;
  return stands && bears(assembly_, lower, upper, joint.kind, normal) ? lower : -1;
}

}  // namespace cupola
