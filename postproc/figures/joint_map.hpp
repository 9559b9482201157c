#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "postproc/figures/gnuplot.hpp"
#include "postproc/figures/shell_maps.hpp"
#include "postproc/tables/shell_map.hpp"

namespace cupola {

/// The joints of the unrolled shell as segments.
class JointMap {
 public:
  using Rows = std::vector<std::vector<double>>;

  explicit JointMap(ShellMap map);

  /// Appends the sides that two blocks share, as x, y, dx, dy and then `value`, if it is given: several where
  /// a block spans rings. With a support: the side below.
  void add(std::pair<int, int> blocks, std::optional<double> value, Rows* rows);

  std::string outlines() const;  ///< data block $outlines, boxes of the blocks
  std::string axes() const;      ///< ranges and labels that hold all segments added
  const ShellMap& shell() const { return map_; }
  /// True for a joint between blocks of the map, or between one of them and a support.
  bool has(const Shell& shell, std::pair<int, int> blocks) const;
  /// False if browsers would be slow to draw the map from vectors.
  bool is_small() const { return map_.boxes.size() <= kMostVectorBoxes; }

 private:
  struct Side {
    double x = 0.0, y = 0.0, dx = 0.0, dy = 0.0;
  };
  std::optional<Side> side_between(const ShellBox& a, const ShellBox& b) const;
  std::vector<Side> sides_of(std::pair<int, int> blocks) const;

  ShellMap map_;
  std::multimap<int, ShellBox> boxes_;
  double low_ = 0.0, high_ = 0.0;
};

}  // namespace cupola
