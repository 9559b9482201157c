#include "solver/contact/blocks/rigid_motions.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "assembly/base/error.hpp"

namespace cupola {

namespace {

/// Whether the axes are orthonormal. In plane problems they are not.
bool is_in_space(const Lever& D) {
  constexpr double kRounding = 1e-9;
  return (D.frame.transpose() * D.frame - Mat3::Identity()).norm() <= kRounding;
}

/// One contact of each pair of touching blocks, seen from the block with the smaller number (column) and from
/// the other one (row).
struct Touch {
  int contact = -1;
  Lever of_column, of_row;  // with the frame of block b
};

/// Touching blocks of each block, with the number of the pair.
struct Neighbours {
  std::vector<int> start;
  std::vector<std::pair<int, int>> block_and_pair;
};

/// Empty if some contact is not one in space.
std::vector<Touch> touches(const ContactProblem& p, const ContactGraph& graph) {
  std::vector<Touch> touch(graph.pattern.num_pairs());
  for (int i = 0; i < p.num_contacts(); ++i) {
    const int pair = graph.pair_of_contact[i];
    if (pair < 0 || touch[pair].contact >= 0) continue;
    const Lever a{-p.D_a[i].frame, p.D_a[i].arm}, b = p.D_b[i];
    if (!is_in_space(a) || !is_in_space(b)) return {};
    const bool a_first = p.block_a[i] < p.block_b[i];
    touch[pair] = {i, a_first ? a : b, a_first ? b : a};
  }
  return touch;
}

template <class Action>
void for_each_pair(const BlockPattern& pattern, const Action& action) {
  for (int column = 0; column < pattern.num_blocks(); ++column) {
    for (int k = pattern.column_start[column]; k < pattern.column_start[column + 1]; ++k)
      action(column, pattern.row[k], k);
  }
}

Neighbours neighbours(const BlockPattern& pattern) {
  Neighbours result;
  result.start.assign(pattern.num_blocks() + 1, 0);
  for_each_pair(pattern, [&](int a, int b, int) { ++result.start[a + 1], ++result.start[b + 1]; });
  std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
  result.block_and_pair.resize(result.start.back());
  std::vector<int> next(result.start.begin(), result.start.end() - 1);
  for_each_pair(pattern, [&](int a, int b, int pair) {
    result.block_and_pair[next[a]++] = {b, pair};
    result.block_and_pair[next[b]++] = {a, pair};
  });
  return result;
}

Mat3 cross(const Vec3& r) {
  Mat3 S;
  S << 0.0, -r[2], r[1], r[2], 0.0, -r[0], -r[1], r[0], 0.0;
  return S;
}

}  // namespace

Mat6 moved_centre(const Vec3& from, const Vec3& to) {
  Mat6 T = Mat6::Identity();
  T.topRightCorner<3, 3>() = cross(from - to);  // v + omega x (to - from)
  return T;
}

RigidMotions rigid_motions(const WhitenedProblem& problem, const ContactGraph& graph) {
  const ContactProblem& p = problem.given;
  const int nb = p.num_blocks();
  CUPOLA_ASSERT(graph.pattern.num_blocks() == nb);
  const std::vector<Touch> touch = touches(p, graph);
  if (static_cast<int>(touch.size()) != graph.pattern.num_pairs()) return {};
  const Neighbours touching = neighbours(graph.pattern);
  RigidMotions motions;
  motions.centre.assign(nb, Vec3::Zero());
  motions.reach.assign(nb, 0.0);
  std::vector<Mat3> turn(nb, Mat3::Identity());  // from the frame of a block to the common frame
  std::vector<char> reached(nb, 0);
  std::vector<int> queue;
  queue.reserve(nb);
  for (int root = 0; root < nb; ++root) {  // breadth first: rounding errors add up along the shortest paths
    if (reached[root]) continue;
    reached[root] = 1;
    queue.push_back(root);
    for (std::size_t head = queue.size() - 1; head < queue.size(); ++head) {
      const int here = queue[head];
      for (int k = touching.start[here]; k < touching.start[here + 1]; ++k) {
        const auto [there, pair] = touching.block_and_pair[k];
        if (reached[there]) continue;
        const Lever& own = here < there ? touch[pair].of_column : touch[pair].of_row;
        const Lever& other = here < there ? touch[pair].of_row : touch[pair].of_column;
        turn[there] = turn[here] * own.frame * other.frame.transpose();
        motions.centre[there] = motions.centre[here] + turn[here] * own.arm - turn[there] * other.arm;
        reached[there] = 1;
        queue.push_back(there);
      }
    }
  }
  for_each_pair(graph.pattern, [&](int a, int b, int pair) {
    motions.reach[a] = std::max(motions.reach[a], touch[pair].of_column.arm.norm());
    motions.reach[b] = std::max(motions.reach[b], touch[pair].of_row.arm.norm());
  });
  motions.motion.resize(nb);
  for (int k = 0; k < nb; ++k) {
    Mat6 own = Mat6::Zero();
    own.topLeftCorner<3, 3>() = own.bottomRightCorner<3, 3>() = turn[k].transpose();
    motions.motion[k] = problem.times_L_transposed(k, own);
  }
  return motions;
}

}  // namespace cupola
