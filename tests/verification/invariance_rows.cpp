// A small dome solved again after a change that must not matter.

#include <algorithm>
#include <stdexcept>

#include <Eigen/Geometry>

#include "generators/generate.hpp"
#include "solver/runtime/threads.hpp"
#include "tests/solver/scenes.hpp"
#include "tests/verification/solve.hpp"
#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

/// A dome with a lantern: all kinds of joints, forces in all directions.
Case small_dome() {
  Case scene;
  RunningBond bond;
  bond.rings = 8;
  bond.blocks_per_ring = 12;
  bond.slices_per_block = 2;
  scene.geometry.bond = bond;
  scene.loads.lantern = TopLoad{0.02};
  scene.analysis.tolerance = 1e-10;
  return scene;
}

JointForces forces_of(const Case& scene, const Assembly& assembly) {
  return joint_forces(solve_equilibrium(scene, assembly).frame);
}

/// How the forces of the changed model follow from those of the original.
struct Image {
  Mat3 rotation = Mat3::Identity();
  double scale = 1.0;                                       ///< factor on forces
  std::function<int(int)> block = [](int b) { return b; };  ///< new number of a block
};

/// Largest difference between the forces of the changed model and the image of the original's, N.
double worst_difference(const JointForces& original, const JointForces& changed, const Image& image) {
  if (original.size() != changed.size()) throw std::runtime_error("the numbers of joints differ");
  double worst = 0.0;
  for (const auto& [pair, force] : original) {
    const int a = image.block(pair.first), b = image.block(pair.second);
    const Vec3 expected = (a < b ? 1.0 : -1.0) * (image.rotation * force);
    const Vec3 found = changed.at({std::min(a, b), std::max(a, b)}) / image.scale;
    worst = std::max(worst, (found - expected).norm());
  }
  return worst;
}

/// Each change alters the scene and the assembly and returns the image that it expects.
using Change = std::function<Image(Case*, Assembly*)>;

void map_vertices(Assembly* assembly, const std::function<Vec3(const Vec3&)>& map) {
  for (Vec3& vertex : assembly->vertices) vertex = map(vertex);
  compute_mass_properties(assembly);
}

Image rotate(Case* scene, Assembly* assembly) {
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  map_vertices(assembly, [&R](const Vec3& x) -> Vec3 { return R * x; });
  scene->loads.gravity = R * scene->loads.gravity;
  return {.rotation = R};
}

Image reflect(Case*, Assembly* assembly) {
  const Mat3 mirror = Vec3(1, -1, 1).asDiagonal();
  for (int f = 0; f < assembly->num_faces(); ++f)  // a reflection reverses the orientation of faces
    std::reverse(assembly->face_vertices.begin() + assembly->face_vertex_start[f],
                 assembly->face_vertices.begin() + assembly->face_vertex_start[f + 1]);
  map_vertices(assembly, [&mirror](const Vec3& x) -> Vec3 { return mirror * x; });
  return {.rotation = mirror};
}

Image renumber(Case*, Assembly* assembly) {
  const int n = static_cast<int>(assembly->blocks.size());
  if (n % 7 == 0) throw std::runtime_error("the permutation needs a number of blocks prime to 7");
  const auto permuted = [n](int block) { return (block * 7 + 3) % n; };
  const std::vector<Block> blocks = assembly->blocks;
  for (int block = 0; block < n; ++block) assembly->blocks[permuted(block)] = blocks[block];
  for (Part& part : assembly->parts) part.block = permuted(part.block);
  std::stable_sort(assembly->parts.begin(), assembly->parts.end(),
                   [](const Part& a, const Part& b) { return a.block < b.block; });
  return {.block = permuted};
}

/// Lengths times 1000 give weights times 1e9; with zero gaps the forces are proportional to the weight.
Image change_unit(Case*, Assembly* assembly) {
  map_vertices(assembly, [](const Vec3& x) -> Vec3 { return 1000.0 * x; });
  return {.scale = 1e9};
}

Image move_far(Case*, Assembly* assembly) {
  map_vertices(assembly, [](const Vec3& x) -> Vec3 { return x + Vec3(3e4, -2e4, 1e4); });
  return {};
}

Change scale_compliance(double factor) {
  return [factor](Case* scene, Assembly*) {
    scene->joints.compliance.normal *= factor;
    scene->joints.compliance.tangential *= factor;
    return Image{};
  };
}

Image solve_one_sector(Case* scene, Assembly*) {
  scene->analysis.cyclic_sectors = 12;
  return {};
}

double difference_over_weight(const Change& change) {
  Case scene = small_dome();
  Assembly assembly = generate(scene);
  const JointForces original = forces_of(scene, assembly);
  const double weight = free_weight(assembly, 9.81);
  const Image image = change(&scene, &assembly);
  return worst_difference(original, forces_of(scene, assembly), image) / weight;
}

/// A tower of blocks that consist of `cells` boxes each, pushed sideways within the kern of its joints.
JointForces tower_forces(int cells, double* weight) {
  Assembly tower = testing::make_boxes({{.center = {0, 0, -0.5}, .size = {6, 6, 1}, .fixed = true}});
  for (int k = 0; k < 4; ++k) {
    testing::BoxSpec slice{.size = {2.0 / cells, 1.0, 0.5}, .ring = k};
    testing::add_block(slice, &tower);
    for (int s = 0; s < cells; ++s) {
      slice.center = {-1.0 + (s + 0.5) * 2.0 / cells, 0.0, (k + 0.5) * 0.5};
      testing::add_box_part(slice, s > 0, s < cells - 1, &tower);
    }
  }
  compute_mass_properties(&tower);
  Case scene;
  scene.joints.compliance = {1e-9, 1e-9, Compliance::Per::area};
  scene.loads.gravity = {1.0, 0.3, -9.81};
  scene.analysis.tolerance = 1e-10;
  *weight = free_weight(tower, 9.81);
  return forces_of(scene, tower);
}

double difference_of_cells() {
  double weight = 0.0;
  const JointForces one = tower_forces(1, &weight), four = tower_forces(4, &weight);
  return worst_difference(one, four, {}) / weight;
}

double invariance(const ReferenceRow& row) {
  const std::string change = row.text("change");
  if (change == "rotation") return difference_over_weight(rotate);
  if (change == "reflection") return difference_over_weight(reflect);
  if (change == "renumbering") return difference_over_weight(renumber);
  if (change == "unit") return difference_over_weight(change_unit);
  if (change == "compliance times 2") return difference_over_weight(scale_compliance(2.0));
  if (change == "compliance over 1e4") return difference_over_weight(scale_compliance(1e-4));
  if (change == "sectors") return difference_over_weight(solve_one_sector);
  if (change == "cells") return difference_of_cells();
  throw std::runtime_error("unknown change " + change);
}

double difference_between_threads(const ReferenceRow&) {
  const Case scene = repository_case("brunelleschi");
  const Assembly dome = generate(scene);
  const int before = num_threads();
  set_num_threads(1);
  const ContactTable one = solve_equilibrium(scene, dome).frame.contacts;
  set_num_threads(2);
  const ContactTable two = solve_equilibrium(scene, dome).frame.contacts;
  set_num_threads(before);
  if (one.size() != two.size()) throw std::runtime_error("the numbers of contacts differ");
  double worst = 0.0;
  for (int i = 0; i < one.size(); ++i)
    worst = std::max(worst, (one.force[i] - two.force[i]).cwiseAbs().maxCoeff());
  return worst;
}

}  // namespace

void add_invariance_rows(Computations* all) {
  Computations& rows = *all;
  rows["invariance"] = invariance;
  rows["invariance_far"] = [](const ReferenceRow&) { return difference_over_weight(move_far); };
  rows["invariance_bits"] = difference_between_threads;
}

}  // namespace cupola::verification
