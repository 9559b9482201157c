#pragma once

#include <optional>
#include <string>

#include "tests/reference/delassus.hpp"

namespace cupola {

/// A problem of the frictional contact library FCLIB (HDF5 files of libfclib), always with Coulomb's law.
struct FclibProblem {
  DelassusProblem local;
  bool was_global = false;       ///< the file has M v = H r + f, u = H^T v + w; reduced to the local form
  std::optional<VecX> impulses;  ///< solution stored in the file
};

/// Reads the local or the global form. W, M and H may be compressed by columns, compressed by rows, or
/// triplets (`nz` of them regardless of nzmax, column indices in `p`, row indices in `i`: the reverse of the
/// comment in fclib.h). Throws InputError with the name of the file if it is not HDF5, has no FCLIB group,
/// has equality constraints, is two-dimensional, or has inconsistent sizes or invalid numbers.
FclibProblem read_fclib(const std::string& path);

/// Writes the local form (compressed by columns) and, unless empty, the impulses as its solution. The file
/// appears only when it is complete.
void write_fclib(const std::string& path, const std::string& title, const DelassusProblem& problem,
                 const VecX& gamma);

}  // namespace cupola
