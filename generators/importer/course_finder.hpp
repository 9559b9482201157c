#pragma once

#include <span>
#include <string>
#include <vector>

#include "generators/importer/joint_graph.hpp"

namespace cupola {

/// Blocks by course, each course in the order in which its stones lie.
struct Courses {
  std::vector<int> course;  ///< per block, -1 for a support
  std::vector<std::vector<int>> stones;
  std::vector<bool> closed;  ///< per course: one ring
  std::string refusal;
};

/// Finds courses by the rules of set_courses(), or takes those of the numbers of the file.
class CourseFinder {
 public:
  CourseFinder(const Assembly& assembly, const JointGraph& graph, std::span<const int> numbers);

  /// Those that begin on the supports `from`.
  Courses find(const std::vector<int>& from);

  /// The faces of a block that meet a support or the course below.
  const std::vector<int>& lower_bed(int block) const { return beds_[block]; }
  /// The blocks of the same course that a block touches.
  std::vector<int> beside(const std::vector<int>& course, int block) const;

 private:
  std::string labels(const std::vector<int>& blocks) const;
  std::vector<int> courses_by_distance(const std::vector<int>& from, std::string* refusal) const;
  std::vector<int> courses_by_number(const std::vector<int>& from) const;
  void set_beds(const std::vector<int>& course);
  double height_of(const std::vector<int>& stones) const;
  bool leans_on_sides(int block) const;
  void check(Courses* found) const;
  bool put_in_order(const std::vector<int>& course, std::vector<int>* stones) const;

  const Assembly& assembly_;
  const JointGraph& graph_;
  std::span<const int> numbers_;        // of courses in the file, per block; empty: none
  std::vector<std::vector<int>> beds_;  // per block
};

}  // namespace cupola
