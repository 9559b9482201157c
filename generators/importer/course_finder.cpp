#include "generators/importer/course_finder.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"
#include "generators/importer/courses.hpp"

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

CourseFinder::CourseFinder(const Assembly& assembly, const JointGraph& graph, std::span<const int> numbers)
    : assembly_(assembly), graph_(graph), numbers_(numbers) {
  std::vector<int> without;
  for (int b = 0; b < static_cast<int>(numbers.size()); ++b)
    if (!assembly.blocks[b].fixed && numbers[b] == kNoCourse) without.push_back(b);
  if (!without.empty())
    throw InputError(fmt::format(
        "geometry.import: the file numbers the courses of other blocks, but not of {}", labels(without)));
}

Courses CourseFinder::find(const std::vector<int>& from) {
  Courses found;
  found.course = numbers_.empty() ? courses_by_distance(from, &found.refusal) : courses_by_number(from);
  const int last = *std::ranges::max_element(found.course);
  if (last < 0 && found.refusal.empty()) found.refusal = "no block is free";
  if (!found.refusal.empty()) return found;
  set_beds(found.course);
  found.stones.resize(static_cast<size_t>(last) + 1);
  for (int b = 0; b < static_cast<int>(found.course.size()); ++b)
    if (found.course[b] >= 0) found.stones[found.course[b]].push_back(b);
  check(&found);
  if (found.refusal.empty())
    for (std::vector<int>& stones : found.stones) found.closed.push_back(put_in_order(found.course, &stones));
  return found;
}

std::vector<int> CourseFinder::courses_by_distance(const std::vector<int>& from, std::string* refusal) const {
  std::vector<int> course = graph_.distances(assembly_, from), unreached;
  for (int b = 0; b < static_cast<int>(course.size()); ++b) {
    if (!assembly_.blocks[b].fixed && course[b] == JointGraph::kFar) unreached.push_back(b);
    course[b] = assembly_.blocks[b].fixed ? -1 : course[b] - 1;
  }
  if (!unreached.empty()) *refusal = "no joints lead from a support to " + labels(unreached);
  return course;
}

/// The ranks of the numbers, counted from the end that lies on the supports.
std::vector<int> CourseFinder::courses_by_number(const std::vector<int>& from) const {
  std::map<int, int> rank;
  for (size_t b = 0; b < numbers_.size(); ++b)
    if (!assembly_.blocks[b].fixed) rank[numbers_[b]] = 0;
  int next = 0;
  for (auto& [number, its_rank] : rank) its_rank = next++;
  int lowest = next;
  for (const int support : from)
    for (const int b : graph_.neighbours[support])
      if (!assembly_.blocks[b].fixed) lowest = std::min(lowest, rank[numbers_[b]]);
  std::vector<int> course(numbers_.size(), -1);
  for (size_t b = 0; b < numbers_.size(); ++b)
    if (!assembly_.blocks[b].fixed)
      course[b] = lowest == 0 ? rank[numbers_[b]] : next - 1 - rank[numbers_[b]];
  return course;
}

std::string CourseFinder::labels(const std::vector<int>& blocks) const {
  return fmt::format("{} {}{}", blocks.size() == 1 ? "block" : "blocks", block_labels(assembly_, blocks),
                     blocks.size() > 8 ? fmt::format(" ({} in all)", blocks.size()) : "");
}

void CourseFinder::set_beds(const std::vector<int>& course) {
  beds_.assign(course.size(), {});
  const auto add = [&](int b, bool on_support) {
    for (const JointGraph::Face& face : graph_.faces[b])
      if (course[face.other] < course[b] && (course[face.other] < 0) == on_support &&
          std::ranges::find(beds_[b], face.face) == beds_[b].end())
        beds_[b].push_back(face.face);
  };
  for (int b = 0; b < static_cast<int>(course.size()); ++b) {
    if (course[b] < 0) continue;
    add(b, false);
    if (beds_[b].empty()) add(b, true);
  }
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
  std::vector<int> hanging, crowded, stepped, leaning;
  for (const std::vector<int>& stones : found->stones) {
    const double height = height_of(stones);
    for (const int b : stones) {
      const std::vector<int> next = beside(found->course, b);
      if (beds_[b].empty()) hanging.push_back(b);
      if (leans_on_sides(b)) leaning.push_back(b);
      if (!numbers_.empty()) continue;
      if (next.size() > 2) crowded.push_back(b);
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
  add("stones that lie on none of a lower number, and on no support", hanging);
  add("stones with more than two neighbours in their course", crowded);
  add("stones whose lower bed does not meet that of their neighbour end to end", stepped);
  add("stones that meet the course below by their sides, too", leaning);
}

/// Orders the stones along their rings and chains; true for one ring, of stones with two neighbours each.
bool CourseFinder::put_in_order(const std::vector<int>& course, std::vector<int>* stones) const {
  std::vector<int> starts, ordered;
  for (const int b : *stones)
    if (beside(course, b).size() < 2) starts.push_back(b);
  const auto west = [&](int b) {
    const Vec3& p = assembly_.blocks[b].centroid;
    return std::array{p.x(), p.y(), p.z()};
  };
  std::ranges::sort(starts, {}, west);
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
  const auto has_two = [&](int b) { return beside(course, b).size() == 2; };
  return pieces == 1 && stones->size() > 2 && std::ranges::all_of(*stones, has_two);
}

}  // namespace cupola
