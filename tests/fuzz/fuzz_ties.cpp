// Springs and rods of brick models, as text. Promise: accepted ties have finite ends, a positive stiffness
// and no negative length.

#include "generators/importer/readers.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace cupola {
namespace {

bool ties_are_sound(std::vector<RawTie> (*read)(const std::string&), const std::string& path) {
  std::vector<RawTie> ties;
  if (!accepts([&] { ties = read(path); })) return false;
  for (const RawTie& tie : ties) {
    demand(tie.point_a.allFinite() && tie.point_b.allFinite(), "ends are finite");
    demand(tie.stiffness > 0.0 && tie.length >= 0.0, "ties have a stiffness and a length");
  }
  return true;
}

}  // namespace

bool reader_accepts(std::string_view bytes) {
  static const ScratchPath scratch(".txt");
  write_bytes(scratch.path, bytes);
  const bool springs = ties_are_sound(read_springs, scratch.path);
  return ties_are_sound(read_rods, scratch.path) || springs;
}

}  // namespace cupola
