#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "assembly/base/named_enum.hpp"
#include "assembly/case/sweep.hpp"

namespace cupola {

// Distributions of one key. Mean and deviation are those of the variable itself.

struct NormalValues {
  double mean = 0.0;
  double deviation = 0.0;  ///< > 0
};
struct LognormalValues {
  double mean = 0.0;       ///< > 0
  double deviation = 0.0;  ///< > 0
};
struct UniformValues {
  double from = 0.0, to = 0.0;
};
struct TriangularValues {
  double from = 0.0, mode = 0.0, to = 0.0;  ///< from <= mode <= to
};
/// One of several texts.
struct TableOfValues {
  std::vector<std::string> values;
  std::vector<double> weights;  ///< empty: equal
};
/// A whole number for each member, for keys that are seeds.
struct SeedValues {};
using Distribution =
    std::variant<NormalValues, LognormalValues, UniformValues, TriangularValues, TableOfValues, SeedValues>;

/// Inverse of the distribution function at u in (0, 1), as text that reads back to the same number.
std::string value_at(const Distribution& distribution, double u);

struct VariedKey {
  std::string key;
  Distribution distribution;
};

/// What stays on the disk of a finished member: summary.json of results/ and post/; also the tables;
/// everything, with a report.
enum class KeptFiles { summary, tables, all };
constexpr auto enum_names(KeptFiles) {
  return std::array{"summary", "tables", "all"};
}

/// Random members of a study.
struct Ensemble {
  /// Independent members, or kReplicates independent Latin hypercubes.
  enum class Design { monte_carlo, latin_hypercube };
  static constexpr int kReplicates = 10;
  int members = 0;  ///< >= 2; of Latin hypercubes a multiple of kReplicates, at least twice that
  int seed = 1;     ///< >= 0
  Design design = Design::monte_carlo;
  KeptFiles keep = KeptFiles::summary;
  std::vector<VariedKey> vary;
};
constexpr auto enum_names(Ensemble::Design) {
  return std::array{"monte_carlo", "latin_hypercube"};
}

/// Draws the members. The values of a key depend on the seed and its path only, so that other keys leave them
/// as they are. More Monte Carlo members continue fewer. Members of one hypercube follow each other.
Samples draw_samples(const Ensemble& ensemble);

/// Samples of another program.
struct SampleFile {
  std::string file;
  KeptFiles keep = KeptFiles::summary;
};

}  // namespace cupola
