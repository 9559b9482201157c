#include "postproc/studies/support_groups.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/base/disjoint_sets.hpp"
#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"

namespace cupola {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr int kMostSupports = 16;
constexpr int kBaseBlocks = 8;  // of a dome whose base is one block

std::vector<Box> boxes_of(const Assembly& assembly) {
  std::vector<Box> boxes(assembly.blocks.size());
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const int v : assembly.face(f)) boxes[part.block].extend(assembly.vertices[v]);
  return boxes;
}

/// True if a face of one convex part has all of the other on its outer side, farther than `distance` (m).
bool is_beyond_a_face(const Assembly& assembly, const Part& part, const Part& other, double distance) {
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
    const Plane plane = polygon_plane(face_points(assembly, f));
    double nearest = std::numeric_limits<double>::infinity();
    for (int g = other.face_start; g < other.face_start + other.num_faces; ++g)
      for (const int v : assembly.face(g))
        nearest = std::min(nearest, plane.normal.dot(assembly.vertices[v]) - plane.offset);
    if (nearest > distance) return true;
  }
  return false;
}

/// True if no face of a part of one block parts it from the other block.
bool touch(const Assembly& assembly, int a, int b, double distance) {
  for (const Part& p : assembly.parts)
    for (const Part& q : assembly.parts)
      if (p.block == a && q.block == b && !is_beyond_a_face(assembly, p, q, distance) &&
          !is_beyond_a_face(assembly, q, p, distance))
        return true;
  return false;
}

/// Joins groups that follow each other by azimuth.
std::vector<std::vector<int>> joined_by_azimuth(std::vector<std::vector<int>> groups,
                                                const Assembly& assembly) {
  const auto place = [&assembly](const std::vector<int>& group) {
    return assembly.blocks[group[0]].centroid;
  };
  Vec3 middle = Vec3::Zero();
  for (const auto& group : groups) middle += place(group) / static_cast<double>(groups.size());
  std::ranges::stable_sort(groups, {}, [&](const std::vector<int>& group) {
    const Vec3 arm = place(group) - middle;
    return std::atan2(arm.y(), arm.x());
  });
  std::vector<std::vector<int>> joined(kMostSupports);
  for (size_t i = 0; i < groups.size(); ++i) {
    std::vector<int>& into = joined[i * kMostSupports / groups.size()];
    into.insert(into.end(), groups[i].begin(), groups[i].end());
  }
  for (auto& group : joined) std::ranges::sort(group);
  return joined;
}

/// The imported name of a block if it can be a part of a folder's name and is not taken for a number; else its
/// number. The blocks of a base that only the runs divide have none.
std::string name_for_run(const Assembly& assembly, int block) {
  const std::string name = block < std::ssize(assembly.blocks) ? assembly.blocks[block].name : "";
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  const bool is_name = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
  return is_name && std::ranges::all_of(name, is_plain) ? name : std::to_string(block);
}

/// True if the base of the case can be divided into several blocks.
bool divides_base(const Case& scene, const std::string& setting) {
  try {
    read_case(scene.file, {setting});
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::vector<std::vector<int>> support_groups(const Assembly& assembly) {
  constexpr double kTouch = 1e-3;  // of the size of a block: supports closer than this touch
  const std::vector<Box> boxes = boxes_of(assembly);
  std::vector<int> fixed;
  for (int b = 0; b < static_cast<int>(assembly.blocks.size()); ++b)
    if (assembly.blocks[b].fixed) fixed.push_back(b);
  DisjointSets touching(assembly.blocks.size());
  for (const int a : fixed)
    for (const int b : fixed) {
      const double distance = kTouch * boxes[a].diagonal().norm();
      if (a < b && boxes[a].exteriorDistance(boxes[b]) <= distance && touch(assembly, a, b, distance))
        touching.join(a, b);
    }
  std::map<int, std::vector<int>> found;
  for (const int b : fixed) found[touching.root(b)].push_back(b);
  if (found.size() == 1)
    for (const int b : fixed) found[b] = {b};
  std::vector<std::vector<int>> groups;
  for (auto& [first, blocks] : found) groups.push_back(std::move(blocks));
  return groups.size() > kMostSupports ? joined_by_azimuth(std::move(groups), assembly) : groups;
}

std::vector<StudyRun> settlement_runs(const RunGroup& group, const std::string& study, const Case& scene,
                                      const Assembly& assembly, std::string* reason) {
  if (!scene.supports.moves.empty()) {
    *reason = "the case moves its supports itself (`supports.moves`)";
    return {};
  }
  std::vector<std::vector<int>> groups = support_groups(assembly);
  std::vector<std::string> settings = group.settings;
  const std::string divided = fmt::format("geometry.base_blocks={}", kBaseBlocks);
  if (groups.size() == 1 && groups[0].size() == 1 && divides_base(scene, divided)) {
    settings.push_back(divided);
    groups.assign(kBaseBlocks, {0});
    for (int k = 0; k < kBaseBlocks; ++k) groups[k] = {k};
  }
  if (groups.size() < 2) {
    *reason = "a single support carries everything, and its settlement opens no joint";
    return {};
  }
  const std::vector<Box> boxes = boxes_of(assembly);
  Box extent;
  for (size_t b = 0; b < boxes.size(); ++b)
    if (!assembly.blocks[b].fixed) extent.extend(boxes[b]);
  const double depth = group.settle * std::max(extent.sizes().x(), extent.sizes().y());
  std::vector<StudyRun> runs;
  for (const std::vector<int>& blocks : groups) {
    runs.push_back({fmt::format("{}/{}_{}", study, group.name, name_for_run(assembly, blocks[0])),
                    group.cases[0], settings});
    runs.back().settings.push_back(
        fmt::format("supports.moves=[{{\"blocks\":[{}],\"displacement\":[0,0,{:.6g}]}}]",
                    fmt::join(blocks, ","), -depth));
  }
  return runs;
}

}  // namespace cupola
