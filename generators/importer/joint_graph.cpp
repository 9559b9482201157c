#include "generators/importer/joint_graph.hpp"

namespace cupola {

JointGraph::JointGraph(const Assembly& assembly, std::span<const FacePair> joints)
    : neighbours(assembly.blocks.size()), faces(assembly.blocks.size()) {
  for (const FacePair& joint : joints) {
    const int a = assembly.parts[joint.part_a].block, b = assembly.parts[joint.part_b].block;
    neighbours[a].insert(b);
    neighbours[b].insert(a);
    faces[a].push_back({joint.face_a, b});
    faces[b].push_back({joint.face_b, a});
  }
}

std::vector<int> JointGraph::distances(const Assembly& assembly, const std::vector<int>& from) const {
  std::vector<int> distance(neighbours.size(), kFar), open = from;
  for (const int b : from) distance[b] = 0;
  for (size_t i = 0; i < open.size(); ++i)
    for (const int next : neighbours[open[i]]) {
      if (assembly.blocks[next].fixed || distance[next] != kFar) continue;
      distance[next] = distance[open[i]] + 1;
      open.push_back(next);
    }
  return distance;
}

std::vector<std::vector<int>> JointGraph::groups_of_supports(const Assembly& assembly) const {
  std::vector<std::vector<int>> groups;
  std::vector<bool> known(neighbours.size(), false);
  for (int b = 0; b < static_cast<int>(neighbours.size()); ++b) {
    if (!assembly.blocks[b].fixed || known[b] || neighbours[b].empty()) continue;
    std::vector<int> group{b};
    known[b] = true;
    for (size_t i = 0; i < group.size(); ++i)
      for (const int next : neighbours[group[i]])
        if (assembly.blocks[next].fixed && !known[next]) {
          known[next] = true;
          group.push_back(next);
        }
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace cupola
