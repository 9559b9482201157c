#include "solver/contact/fclib_file.hpp"

#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include <Eigen/SparseCholesky>
#include <fmt/format.h>
#include <hdf5.h>

extern "C" {
#include <fclib.h>
}

#include "assembly/atomic_file.hpp"
#include "assembly/error.hpp"

namespace cupola {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

[[noreturn]] void reject(const std::string& path, const std::string& what) {
  throw InputError(FileLocation{path}, "FCLIB: " + what);
}

/// libfclib ends the process when a name is missing, so the names are looked up first.
class NameCheck {
 public:
  explicit NameCheck(const std::string& path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    if (H5Fis_hdf5(path.c_str()) <= 0) reject(path, "not an HDF5 file, or it cannot be read");
    file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file_ < 0) reject(path, "cannot be opened");
  }
  ~NameCheck() { H5Fclose(file_); }
  NameCheck(const NameCheck&) = delete;
  NameCheck& operator=(const NameCheck&) = delete;

  bool has(const std::string& name) const {
    for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
      if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
      if (end == std::string::npos) return true;
    }
  }
  void require(const std::string& path, const std::string& group,
               const std::vector<std::string>& names) const {
    for (const std::string& name : names) {
      if (!has(group + name)) reject(path, fmt::format("{}{} is missing", group, name));
    }
  }

 private:
  hid_t file_;
};

std::vector<std::string> matrix_names(const std::string& name) {
  std::vector<std::string> names;
  for (const char* field : {"nzmax", "m", "n", "nz", "p", "i", "x"}) names.push_back(name + "/" + field);
  return names;
}

Sparse to_sparse(const std::string& path, const char* name, const fclib_matrix& A) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int row, int column, double value) {
    if (row < 0 || row >= A.m || column < 0 || column >= A.n || !std::isfinite(value)) {
      reject(path, fmt::format("{} has an entry ({}, {}) = {} outside its {} x {}", name, row, column, value,
                               A.m, A.n));
    }
    entries.emplace_back(row, column, value);
  };
  const bool triplets = A.nz >= 0, by_rows = A.nz == -2;
  if (triplets) {
    for (int k = 0; k < A.nz; ++k) add(A.i[k], A.p[k], A.x[k]);
  } else {
    for (int major = 0; major < (by_rows ? A.m : A.n); ++major) {
      for (int k = A.p[major]; k < A.p[major + 1]; ++k) {
        if (k < 0 || k >= A.nzmax) reject(path, fmt::format("{} points to entry {} of {}", name, k, A.nzmax));
        add(by_rows ? major : A.i[k], by_rows ? A.i[k] : major, A.x[k]);
      }
    }
  }
  Sparse matrix(A.m, A.n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

VecX to_vector(const std::string& path, const char* name, const double* values, Eigen::Index size) {
  if (values == nullptr) reject(path, fmt::format("{} is missing", name));
  VecX vector = Eigen::Map<const VecX>(values, size);
  if (!vector.allFinite()) reject(path, fmt::format("{} is not finite", name));
  return vector;
}

void check_contacts(const std::string& path, int spacedim, Eigen::Index rows) {
  if (spacedim != 3) reject(path, fmt::format("space dimension {}: only 3 is solved here", spacedim));
  if (rows == 0 || rows % 3 != 0) reject(path, fmt::format("{} contact rows are no multiple of 3", rows));
}

DelassusProblem read_local(const std::string& path, const NameCheck& names) {
  names.require(path, "/fclib_local/", matrix_names("W"));
  names.require(path, "/fclib_local/", {"spacedim", "vectors/q", "vectors/mu"});
  if (names.has("/fclib_local/V")) reject(path, "equality constraints (V, R) are not solved here");
  const std::unique_ptr<fclib_local, void (*)(fclib_local*)> p(fclib_read_local(path.c_str()),
                                                               [](fclib_local* q) {
                                                                 fclib_delete_local(q);
                                                                 std::free(q);
                                                               });
  check_contacts(path, p->spacedim, p->W->m);
  if (p->W->m != p->W->n) reject(path, fmt::format("W is {} x {}, not square", p->W->m, p->W->n));
  return {to_sparse(path, "W", *p->W), to_vector(path, "q", p->q, p->W->m),
          to_vector(path, "mu", p->mu, p->W->m / 3)};
}

/// W = H^T M^-1 H, q = H^T M^-1 f + w.
DelassusProblem read_global(const std::string& path, const NameCheck& names) {
  names.require(path, "/fclib_global/", matrix_names("M"));
  names.require(path, "/fclib_global/", matrix_names("H"));
  names.require(path, "/fclib_global/", {"spacedim", "vectors/f", "vectors/w", "vectors/mu"});
  if (names.has("/fclib_global/G")) reject(path, "equality constraints (G) are not solved here");
  const std::unique_ptr<fclib_global, void (*)(fclib_global*)> p(fclib_read_global(path.c_str()),
                                                                 [](fclib_global* q) {
                                                                   fclib_delete_global(q);
                                                                   std::free(q);
                                                                 });
  check_contacts(path, p->spacedim, p->H->n);
  if (p->M->m != p->M->n || p->M->m != p->H->m) {
    reject(path, fmt::format("M is {} x {} and H {} x {}", p->M->m, p->M->n, p->H->m, p->H->n));
  }
  const Sparse M = to_sparse(path, "M", *p->M), H = to_sparse(path, "H", *p->H);
  const Eigen::SimplicialLDLT<Sparse> factor(M);
  if (factor.info() != Eigen::Success) reject(path, "M cannot be factorised: not positive definite");
  const VecX f = to_vector(path, "f", p->f, p->M->m);
  DelassusProblem local;
  local.W = Sparse(H.transpose() * Sparse(factor.solve(H)));
  local.q = H.transpose() * factor.solve(f) + to_vector(path, "w", p->w, p->H->n);
  local.mu = to_vector(path, "mu", p->mu, p->H->n / 3);
  return local;
}

/// Of a local problem; libfclib writes and reads those of a global one with sizes that contradict each other.
std::optional<VecX> read_impulses(const std::string& path, const NameCheck& names, Eigen::Index size) {
  if (!names.has("/solution/r") || !names.has("/solution/u")) return std::nullopt;
  const std::unique_ptr<fclib_solution, void (*)(fclib_solution*)> s(
      fclib_read_solution(path.c_str()), [](fclib_solution* q) { fclib_delete_solutions(q, 1); });
  if (!s || s->r == nullptr) return std::nullopt;
  return to_vector(path, "solution r", s->r, size);
}

}  // namespace

FclibProblem read_fclib(const std::string& path) {
  const NameCheck names(path);
  FclibProblem problem;
  if (names.has("/fclib_local")) {
    problem.local = read_local(path, names);
    problem.impulses = read_impulses(path, names, problem.local.q.size());
  } else if (names.has("/fclib_global")) {
    problem.local = read_global(path, names);
    problem.was_global = true;
  } else {
    reject(path, "neither /fclib_local nor /fclib_global is there");
  }
  if (problem.local.mu.minCoeff() < 0.0)
    reject(path, fmt::format("mu = {} < 0", problem.local.mu.minCoeff()));
  return problem;
}

void write_fclib(const std::string& path, const std::string& title, const DelassusProblem& problem,
                 const VecX& gamma) {
  Sparse W = problem.W;
  W.makeCompressed();
  VecX q = problem.q, mu = problem.mu, r = gamma;
  VecX u = r.size() == 0 ? VecX() : VecX(W * r + q);
  std::string title_text = title, description = "written by cupola-solve", math = "W = D^T M^-1 D + E";
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
