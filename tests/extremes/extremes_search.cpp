// Searches random scenes for those that are hardest for the solver.
//
//   extremes_search SECONDS FIRST_SEED      tries seeds under both friction laws for SECONDS of wall time
//
// Prints every scene with a wrong answer or without one, unless its reference has none either, and the ones
// with the most iterations.

#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "assembly/program/program.hpp"
#include "tests/arguments.hpp"
#include "tests/extremes/random_scene.hpp"

namespace {

using namespace cupola;

struct Found {
  std::string name;
  ExtremeResult result;
};

void print(const Found& found) {
  const ExtremeResult& r = found.result;
  fmt::print("{:28} {:11} {:8} {:6d} iterations {:7.2f} s  true {:.1e} stated {}  {}\n", found.name,
             to_string(r.ending), to_string(r.verdict), r.iterations, r.seconds, r.error.largest, r.stated,
             r.reason.substr(0, 120));
}

ExitCode search(double seconds, std::uint64_t first) {
  constexpr size_t kPrinted = 10;
  std::vector<Found> all;
  std::uint64_t seed = first;
  for (const double start = wall_seconds(); wall_seconds() - start < seconds; ++seed)
    for (const auto law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
      for (const ExtremeScene& row : {random_row(seed, law), random_tower_row(seed, law)}) {
        all.push_back({row.name, run_extreme(row)});
        if (all.back().result.verdict != Verdict::right && all.back().result.error.has_reference)
          print(all.back());
      }
    }
  std::sort(all.begin(), all.end(),
            [](const Found& a, const Found& b) { return a.result.iterations > b.result.iterations; });
  fmt::print("\nmost iterations of {} scenes, seeds {} to {}:\n", all.size(), first, seed - 1);
  for (size_t k = 0; k < std::min(kPrinted, all.size()); ++k) print(all[k]);
  return ExitCode::done;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("extremes_search", [&] {
    const auto arguments = read_arguments(argc, argv, 2, 2, "extremes_search SECONDS FIRST_SEED");
    return search(std::stod(arguments[0]), std::stoull(arguments[1]));
  });
}
