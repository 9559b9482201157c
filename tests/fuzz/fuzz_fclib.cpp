// FCLIB problems (HDF5) as bytes. Promise: an accepted problem has matching sizes, finite numbers and
// friction coefficients >= 0.

#include "solver/fclib/fclib_file.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace cupola {

bool reader_accepts(std::string_view bytes) {
  static const ScratchPath scratch(".hdf5");
  write_bytes(scratch.path, bytes);
  FclibProblem file;
  if (!accepts([&] { file = read_fclib(scratch.path); })) return false;
  const DelassusProblem& problem = file.local;
  const Eigen::Index rows = 3 * problem.mu.size();
  demand(rows > 0 && problem.q.size() == rows && problem.W.rows() == rows && problem.W.cols() == rows,
         "sizes belong together");
  demand(problem.mu.allFinite() && problem.mu.minCoeff() >= 0.0, "friction is not negative");
  demand(problem.q.allFinite(), "numbers are finite");
  demand(!file.impulses || file.impulses->size() == rows, "the solution has the problem's size");
  return true;
}

}  // namespace cupola
