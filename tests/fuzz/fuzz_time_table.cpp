// Tables of a function of time, as text. Promise: accepted times increase and every value is finite.

#include <algorithm>
#include <cmath>
#include <functional>

#include "assembly/files/time_table.hpp"
#include "assembly/model/time_function.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace cupola {

bool reader_accepts(std::string_view bytes) {
  static const ScratchPath scratch("_table.csv");
  write_bytes(scratch.path, bytes);
  TableInTime table;
  if (!accepts([&] { table = read_time_table(scratch.path); })) return false;
  demand(!table.times.empty() && table.times.size() == table.values.size(), "rows have a time and a value");
  demand(std::ranges::is_sorted(table.times, std::less_equal<>()), "times increase");
  demand(std::ranges::all_of(table.values, [](double x) { return std::isfinite(x); }), "values are finite");
  return true;
}

}  // namespace cupola
