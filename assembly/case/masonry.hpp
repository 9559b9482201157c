#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/case/bond.hpp"

namespace cupola {

/// A thickness that varies over the height: values between `heights`, constant beyond both ends.
struct Thickness {
  std::vector<double> heights;      ///< m above the springing, ascending
  std::vector<double> values{1.0};  ///< m, > 0, one per height; one without heights

  bool constant() const { return values.size() == 1; }
  double at(double height) const;  ///< m
};

/// Heights above the springing, m, between which a wythe or its bonders exist. A course belongs to the range
/// in which the middle of its intrados at a corner lies.
struct HeightRange {
  double from = 0.0;              ///< >= 0; 0: from the first course, whatever its height
  std::optional<double> to = {};  ///< none: to the top

  bool contains(double height) const { return (from == 0.0 || height >= from) && (!to || height < *to); }
};

/// One layer of the thickness, as of a wall of two leaves or a dome of two shells.
struct Wythe {
  std::string name;
  Thickness thickness;
  std::optional<Bond> bond = {};  ///< none: a cavity, empty where no bonder crosses it
  HeightRange where;
};

/// Blocks through several wythes, one course high: headers of a wall, ribs, the solid base of two shells. In
/// the courses selected, `per_ring` of them stand at equal spacing and replace what the wythes have there.
struct Bonders {
  std::string name;
  std::string from, to;         ///< the first and the last wythe that they occupy, inside first
  int per_ring = 1;             ///< >= 1, of each position in `at`
  std::vector<double> at{0.5};  ///< middles, in spacings from abscissa 0 (the first corner), in [0, 1)
  double width = 1.0;           ///< over the spacing, in (0, 1]
  double shift = 0.0;           ///< spacings by which every other of these courses is moved, in [0, 1)
  int every = 1;                ///< courses from one to the next, >= 1
  int first = 0;                ///< courses of the height range below the first
  HeightRange where;
};

/// How a wall or shell is built up through its thickness.
struct Masonry {
  Bond bond = RunningBond{};  ///< of the whole thickness
  /// Layers through the thickness, inside first. If there are any, `bond` and a single thickness are ignored.
  std::vector<Wythe> wythes;
  std::vector<Bonders> bonders;
};

}  // namespace cupola
