#include "generators/importer/course_finder.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "assembly/model/block_names.hpp"

namespace cupola {
namespace {

constexpr double kEndToEnd = 0.25;  // of the height of a course

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double s = d.squaredNorm() > 0.0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - a - s * d).norm();
}

/// Least distance of a corner of one of the faces from an edge of the others, m.
double distance_of_faces(const Assembly& assembly, const std::vector<int>& from, const std::vector<int>& to) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [some, others] : {std::pair(&from, &to), std::pair(&to, &from)})
    for (const int f : *some)
      for (const Vec3& corner : face_points(assembly, f))
        for (const int g : *others) {
          const std::vector<Vec3> polygon = face_points(assembly, g);
          for (size_t i = 0; i < polygon.size(); ++i)
            least =
                std::min(least, distance_to_segment(corner, polygon[i], polygon[(i + 1) % polygon.size()]));
        }
  return least;
}

}  // namespace

Courses CourseFinder::find(const std::vector<int>& from) {
  const std::vector<int> distance = graph_.distances(assembly_, from);
  Courses found;
  found.course.assign(distance.size(), -1);
  std::vector<int> unreached;
  int last = -1;
  for (int b = 0; b < static_cast<int>(distance.size()); ++b) {
    if (assembly_.blocks[b].fixed) continue;
    if (distance[b] == JointGraph::kFar) {
      unreached.push_back(b);
      continue;
    }
    found.course[b] = distance[b] - 1;
    last = std::max(last, found.course[b]);
  }
  if (!unreached.empty() || last < 0) {
    found.refusal =
        unreached.empty() ? "no block is free" : "no joints lead from a support to " + labels(unreached);
    return found;
  }
  set_beds(found.course);
  found.stones.resize(static_cast<size_t>(last) + 1);
  for (int b = 0; b < static_cast<int>(distance.size()); ++b)
    if (found.course[b] >= 0) found.stones[found.course[b]].push_back(b);
  check(&found);
  if (found.refusal.empty())
    for (std::vector<int>& stones : found.stones) found.closed.push_back(put_in_order(found.course, &stones));
  return found;
}

std::string CourseFinder::labels(const std::vector<int>& blocks) const {
  return fmt::format("{} {}{}", blocks.size() == 1 ? "block" : "blocks", block_labels(assembly_, blocks),
                     blocks.size() > 8 ? fmt::format(" ({} in all)", blocks.size()) : "");
}

void CourseFinder::set_beds(const std::vector<int>& course) {
  beds_.assign(course.size(), {});
  for (int b = 0; b < static_cast<int>(course.size()); ++b)
    for (const JointGraph::Face& face : graph_.faces[b])
      if (course[b] >= 0 && course[face.other] == course[b] - 1 &&
          std::ranges::find(beds_[b], face.face) == beds_[b].end())
        beds_[b].push_back(face.face);
}

std::vector<int> CourseFinder::beside(const std::vector<int>& course, int block) const {
  std::vector<int> beside;
  for (const int next : graph_.neighbours[block])
    if (course[next] == course[block]) beside.push_back(next);
  return beside;
}

/// m: mean over the stones of volume over area of the lower bed.
double CourseFinder::height_of(const std::vector<int>& stones) const {
  double volume = 0.0, area = 0.0;
  for (const int b : stones) {
    volume += assembly_.blocks[b].volume;
    for (const int f : beds_[b]) area += polygon_area(face_points(assembly_, f));
  }
  return area > 0.0 ? volume / area : 0.0;
}

/// True if the faces by which a stone meets the course below look into different directions, as those of an
/// upright stone between lower ones do.
bool CourseFinder::leans_on_sides(int block) const {
  constexpr double kSameSide = 0.7;  // cosine of the angle to their mean
  Vec3 mean = Vec3::Zero();
  for (const int f : beds_[block]) {
    const std::vector<Vec3> polygon = face_points(assembly_, f);
    mean += polygon_area(polygon) * polygon_plane(polygon).normal;
  }
  mean.stableNormalize();
  return std::ranges::any_of(beds_[block], [&](int f) {
    return polygon_plane(face_points(assembly_, f)).normal.dot(mean) < kSameSide;
  });
}

void CourseFinder::check(Courses* found) const {
  std::vector<int> crowded, stepped, leaning;
  for (const std::vector<int>& stones : found->stones) {
    const double height = height_of(stones);
    for (const int b : stones) {
      const std::vector<int> next = beside(found->course, b);
      if (next.size() > 2) crowded.push_back(b);
      if (leans_on_sides(b)) leaning.push_back(b);
      if (std::ranges::any_of(next, [&](int other) {
            return distance_of_faces(assembly_, beds_[b], beds_[other]) > kEndToEnd * height;
          }))
        stepped.push_back(b);
    }
  }
  const auto add = [&](const char* what, const std::vector<int>& stones) {
    if (stones.empty()) return;
    found->refusal += (found->refusal.empty() ? "" : "; ") + std::string(what) + ": " + labels(stones);
  };
  add("stones with more than two neighbours in their course", crowded);
  add("stones whose lower bed does not meet that of their neighbour end to end", stepped);
  add("stones that meet the course below by their sides, too", leaning);
}

/// Orders the stones along their rings and chains; true for one ring.
bool CourseFinder::put_in_order(const std::vector<int>& course, std::vector<int>* stones) const {
  std::vector<int> starts, ordered;
  for (const int b : *stones)
    if (beside(course, b).size() < 2) starts.push_back(b);
  const auto west = [&](int b) {
    const Vec3& p = assembly_.blocks[b].centroid;
    return std::array{p.x(), p.y(), p.z()};
  };
  std::ranges::sort(starts, {}, west);
  const size_t num_ends = starts.size();
  starts.insert(starts.end(), stones->begin(), stones->end());  // of rings, which have no ends
  std::set<int> done;
  int pieces = 0;
  for (const int start : starts) {
    if (!done.insert(start).second) continue;
    ++pieces;
    std::vector<int> chain{start};
    for (size_t i = 0; i < chain.size(); ++i)
      for (const int next : beside(course, chain[i]))
        if (done.insert(next).second) {
          chain.push_back(next);
          break;
        }
    ordered.insert(ordered.end(), chain.begin(), chain.end());
  }
  *stones = std::move(ordered);
  return pieces == 1 && num_ends == 0 && stones->size() > 2;
}

}  // namespace cupola
