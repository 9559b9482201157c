#pragma once

#include <optional>
#include <string>

#include "solver/contact/problem/delassus.hpp"

namespace cupola {

/// A problem of the frictional contact library FCLIB (HDF5, written and read by libfclib), always Coulomb's
/// law.
struct FclibProblem {
  DelassusProblem local;
  bool was_global = false;       ///< M v = H r + f, u = H^T v + w, reduced to the local form here
  std::optional<VecX> impulses;  ///< solution stored in the file
};

/// Reads the local or the global form, W, M and H compressed by columns, by rows or as triplets (column
/// indices in `p`, row indices in `i`, the reverse of fclib.h's comment; `nz` of them, whatever nzmax).
/// Throws InputError naming the file: no HDF5, no FCLIB group, equality constraints, plane problems, sizes or
/// numbers that do not fit.
FclibProblem read_fclib(const std::string& path);

/// Writes the local form (compressed by columns) and, unless empty, the impulses as its solution; aside and
/// renamed.
void write_fclib(const std::string& path, const std::string& title, const DelassusProblem& problem,
                 const VecX& gamma);

}  // namespace cupola
