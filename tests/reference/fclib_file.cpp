#include "tests/reference/fclib_file.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/SparseCholesky>
#include <fmt/format.h>

extern "C" {
#include <fclib.h>
}

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "tests/reference/hdf5_reader.hpp"

namespace cupola {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

[[noreturn]] void reject(const std::string& path, const std::string& what) {
  throw InputError(FileLocation{path}, "FCLIB: " + what);
}

/// Reads W, M or H, whose size must be `rows` x `columns` to match the vectors of the problem.
Sparse read_matrix(const Hdf5Reader& file, const std::string& name, Eigen::Index rows, Eigen::Index columns) {
  const int m = file.integer(name + "/m"), n = file.integer(name + "/n"), nz = file.integer(name + "/nz");
  if (m != rows || n != columns)
    reject(file.path(),
           fmt::format("{} is {} x {}, but its vectors require {} x {}", name, m, n, rows, columns));
  const std::vector<int> p = file.integers(name + "/p"), i = file.integers(name + "/i");
  const std::vector<double> x = file.numbers(name + "/x");
  const bool triplets = nz >= 0, by_rows = nz == -2;
  if (nz < -2)
    reject(
        file.path(),
        fmt::format("{}/nz = {}: must be -2 (by rows), -1 (by columns) or a number of triplets", name, nz));
  const std::size_t majors = static_cast<std::size_t>(by_rows ? m : n);
  if (p.size() < (triplets ? static_cast<std::size_t>(nz) : majors + 1))
    reject(file.path(),
           fmt::format("{}/p has {}, fewer than its matrix requires", name, counted(p.size(), "element")));

  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](std::size_t k, int row, int column) {
    if (row < 0 || row >= m || column < 0 || column >= n || !std::isfinite(x[k])) {
      reject(file.path(), fmt::format("{} has the entry ({}, {}) = {}: must be finite and inside its {} x {}",
                                      name, row, column, x[k], m, n));
    }
    entries.emplace_back(row, column, x[k]);
  };
  const auto check_entry = [&](long long k) {
    const auto stored = static_cast<long long>(std::min(i.size(), x.size()));
    if (k < 0 || k >= stored)
      reject(file.path(), fmt::format("{} refers to entry {} of {}", name, k, stored));
    return static_cast<std::size_t>(k);
  };
  if (triplets) {
    for (int k = 0; k < nz; ++k) add(check_entry(k), i[check_entry(k)], p[static_cast<std::size_t>(k)]);
  } else {
    for (std::size_t major = 0; major < majors; ++major) {
      if (p[major + 1] < p[major]) reject(file.path(), name + "/p must not decrease");
      for (int k = p[major]; k < p[major + 1]; ++k) {
        const std::size_t at = check_entry(k);
        const int here = static_cast<int>(major);
        add(at, by_rows ? here : i[at], by_rows ? i[at] : here);
      }
    }
  }
  Sparse matrix(m, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

VecX read_vector(const Hdf5Reader& file, const std::string& name) {
  const std::vector<double> values = file.numbers(name);
  VecX vector = Eigen::Map<const VecX>(values.data(), static_cast<Eigen::Index>(values.size()));
  if (!vector.allFinite()) reject(file.path(), fmt::format("{} is not finite", name));
  return vector;
}

void check_contacts(const Hdf5Reader& file, int spacedim, Eigen::Index rows, const VecX& mu) {
  if (spacedim != 3) reject(file.path(), fmt::format("space dimension {}: only 3 is supported", spacedim));
  if (rows == 0 || rows != 3 * mu.size())
    reject(file.path(), fmt::format("{} for {}: must be three per contact, and at least one contact",
                                    counted(rows, "contact row"), counted(mu.size(), "contact")));
  if (mu.minCoeff() < 0.0) reject(file.path(), fmt::format("mu = {} < 0", mu.minCoeff()));
}

DelassusProblem read_local(const Hdf5Reader& file) {
  if (file.has("/fclib_local/V")) reject(file.path(), "equality constraints (V, R) are not supported");
  DelassusProblem local;
  local.q = read_vector(file, "/fclib_local/vectors/q");
  local.mu = read_vector(file, "/fclib_local/vectors/mu");
  check_contacts(file, file.integer("/fclib_local/spacedim"), local.q.size(), local.mu);
  local.W = read_matrix(file, "/fclib_local/W", local.q.size(), local.q.size());
  return local;
}

/// W = H^T M^-1 H, q = H^T M^-1 f + w.
DelassusProblem read_global(const Hdf5Reader& file) {
  if (file.has("/fclib_global/G")) reject(file.path(), "equality constraints (G) are not supported");
  const VecX f = read_vector(file, "/fclib_global/vectors/f"),
             w = read_vector(file, "/fclib_global/vectors/w");
  DelassusProblem local;
  local.mu = read_vector(file, "/fclib_global/vectors/mu");
  check_contacts(file, file.integer("/fclib_global/spacedim"), w.size(), local.mu);
  const Sparse M = read_matrix(file, "/fclib_global/M", f.size(), f.size());
  const Sparse H = read_matrix(file, "/fclib_global/H", f.size(), w.size());
  const Eigen::SimplicialLDLT<Sparse> factor(M);
  if (factor.info() != Eigen::Success)
    reject(file.path(), "M cannot be factorised: it must be positive definite");
  local.W = Sparse(H.transpose() * Sparse(factor.solve(H)));
  local.q = H.transpose() * factor.solve(f) + w;
  const bool finite = local.q.allFinite() && local.W.coeffs().allFinite();
  if (!finite) reject(file.path(), "M is singular in double precision");
  return local;
}

/// Solution of a local problem, if the file has one. (libfclib writes solutions of global problems with
/// contradictory sizes. Public problems declare solutions without data.)
std::optional<VecX> read_impulses(const Hdf5Reader& file, Eigen::Index size) {
  if (!file.written("/solution/r")) return std::nullopt;
  VecX impulses = read_vector(file, "/solution/r");
  if (impulses.size() != size)
    reject(file.path(),
           fmt::format("/solution/r has {}, expected {}", counted(impulses.size(), "element"), size));
  return impulses;
}

}  // namespace

// libfclib allocates arrays of the sizes stated in a file, regardless of the arrays in it, and ends the
// process if a name is missing. We use it for writing only.
FclibProblem read_fclib(const std::string& path) {
  const Hdf5Reader file(path);
  FclibProblem problem;
  if (file.has("/fclib_local")) {
    problem.local = read_local(file);
    problem.impulses = read_impulses(file, problem.local.q.size());
  } else if (file.has("/fclib_global")) {
    problem.local = read_global(file);
    problem.was_global = true;
  } else {
    reject(path, "has neither /fclib_local nor /fclib_global");
  }
  return problem;
}

void write_fclib(const std::string& path, const std::string& title, const DelassusProblem& problem,
                 const VecX& gamma) {
  CUPOLA_ASSERT(problem.W.rows() == problem.q.size() && problem.q.size() == 3 * problem.num_contacts());
  CUPOLA_ASSERT(gamma.size() == 0 || gamma.size() == problem.q.size());
  Sparse W = problem.W;
  W.makeCompressed();
  VecX q = problem.q, mu = problem.mu, r = gamma;
  VecX u = r.size() == 0 ? VecX() : VecX(W * r + q);
  std::string title_text = title, description = "written by Cupola", math = "W = D^T M^-1 D + E";
  fclib_info info{title_text.data(), description.data(), math.data()};
  const int n = static_cast<int>(W.rows());
  fclib_matrix matrix{
      static_cast<int>(W.nonZeros()), n, n, W.outerIndexPtr(), W.innerIndexPtr(), W.valuePtr(), -1, nullptr};
  fclib_local local{};
  local.W = &matrix;
  local.mu = mu.data();
  local.q = q.data();
  local.spacedim = 3;
  local.info = &info;
  fclib_solution solution{nullptr, u.data(), r.data(), nullptr};
  write_atomically(path, [&](const std::string& side_path) {
    return fclib_write_local(&local, side_path.c_str()) != 0 &&
           (r.size() == 0 || fclib_write_solution(&solution, side_path.c_str()) != 0);
  });
}

}  // namespace cupola
