// The worst scenes that `make -f Makefile.cases extremes-search` has found.

#include "tests/extremes/random_scene.hpp"
#include "tests/extremes/rows.hpp"

namespace cupola {

void add_random_rows(Rows* rows) {
  for (const std::uint64_t seed : {1, 2, 3}) rows->push_back(random_row(seed, FrictionLaw::associated));
}

}  // namespace cupola
