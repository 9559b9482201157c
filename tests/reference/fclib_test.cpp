#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

extern "C" {
#include <fclib.h>
}

#include "assembly/base/error.hpp"
#include "solver/contact/methods/solve_contact.hpp"
#include "tests/reference/delassus_newton.hpp"
#include "tests/reference/fclib_file.hpp"
#include "tests/solver/contact/contact_scenes.hpp"

namespace cupola::fclib_test {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Path of a file of this test in the temporary folder.
std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("cupola_fclib_test_" + name)).string();
}

std::filesystem::path shared_fclib() {
  const char* root = std::getenv("CUPOLA_SHARED_DATA");
  const std::filesystem::path data =
      root != nullptr ? root : std::filesystem::path(CUPOLA_SOURCE_DIR) / "../shared/data";
  return data / "fclib";
}

ContactProblem sample_problem() {
  scenes::DomeShape shape;
  shape.rings = 4;
  shape.blocks_per_ring = 6;
  return scenes::dome(shape, 0.01, {0.4, 1e-8, 3e-9});
}

VecX solved_impulses(const ContactProblem& problem, FrictionLaw law) {
  ContactSolverOptions options;
  options.tolerance = 1e-12;
  options.reference_speed = 0.0981;
  options.law = law;
  ContactSolution x;
  EXPECT_EQ(solve_contact(problem, options, &x).ending, SolveEnding::converged);
  return x.gamma;
}

TEST(Delassus, MatchesTheVelocityForm) {
  const ContactProblem problem = sample_problem();
  const DelassusProblem local = make_delassus(problem);
  const VecX gamma = VecX::Random(problem.b.size());
  VecX v = generalized_impulse(problem, gamma);
  for (int k = 0; k < problem.num_blocks(); ++k) {
    v.segment<6>(6 * k) = problem.M[k].ldlt().solve(v.segment<6>(6 * k).eval()).eval();
  }
  v += problem.v_star;
  const VecX u = relative_velocity(problem, v) + problem.b + problem.E.cwiseProduct(gamma);
  EXPECT_LE((local.W * gamma + local.q - u).norm(), 1e-12 * u.norm());
}

TEST(Delassus, NewtonFindsTheImpulsesOfTheVelocityForm) {
  const ContactProblem problem = sample_problem();
  const DelassusProblem local = make_delassus(problem);
  for (const FrictionLaw law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
    const VecX reference = solved_impulses(problem, law);
    VecX gamma;
    DelassusOptions options;
    options.law = law;
    options.tolerance = 1e-11;
    const SolveSummary summary = solve_delassus(local, options, &gamma);
    EXPECT_EQ(summary.ending, SolveEnding::converged) << summary.message;
    EXPECT_LE((gamma - reference).norm(), 1e-8 * reference.norm())
        << to_string(law);  // residual over min E / |N|
  }
}

TEST(Fclib, RoundTripKeepsEveryBit) {
  const ContactProblem problem = sample_problem();
  const DelassusProblem local = make_delassus(problem);
  const VecX gamma = solved_impulses(problem, FrictionLaw::associated);
  const std::string path = temporary("round_trip.hdf5");
  write_fclib(path, "a small dome", local, gamma);
  const FclibProblem read = read_fclib(path);
  EXPECT_FALSE(read.was_global);
  EXPECT_EQ((read.local.W - local.W).norm(), 0.0);
  EXPECT_EQ(read.local.q, local.q);
  EXPECT_EQ(read.local.mu, local.mu);
  ASSERT_TRUE(read.impulses.has_value());
  EXPECT_EQ(*read.impulses, gamma);
  write_fclib(path, "without a solution", local, VecX());
  EXPECT_FALSE(read_fclib(path).impulses.has_value());
  std::filesystem::remove(path);
}

TEST(Fclib, RejectsInvalidFilesWithAMessage) {
  const auto message_of = [](const std::string& path) -> std::string {
    try {
      read_fclib(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(message_of(temporary("absent.hdf5")).find("not an HDF5 file"), std::string::npos);
  const std::string text = temporary("text.hdf5");
  std::ofstream(text) << "no HDF5";
  EXPECT_NE(message_of(text).find("not an HDF5 file"), std::string::npos);
  std::filesystem::remove(text);

  const std::string path = temporary("bad.hdf5");
  DelassusProblem local = make_delassus(sample_problem());
  const DelassusProblem good = local;
  local.mu[3] = -1.0;
  write_fclib(path, "negative friction", local, VecX());
  EXPECT_NE(message_of(path).find("mu = -1 < 0"), std::string::npos) << message_of(path);
  local = good;
  local.q[5] = std::nan("");
  write_fclib(path, "NaN", local, VecX());
  EXPECT_NE(message_of(path).find("q is not finite"), std::string::npos) << message_of(path);
  write_fclib(path, "cut", good, VecX());
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_NE(message_of(path), "accepted");
  std::filesystem::remove(path);
}

// W = 2 I with three rows, q = -e1, mu = 0.4: valid files, and files with one false array. libfclib would
// write past the end of arrays of the stated sizes (bad_m, bad_nz, nzmax_too_small), or end the process
// (bad_text).
TEST(Fclib, ChecksSizesAndOpensNoOtherFile) {
  const std::string seeds = CUPOLA_SOURCE_DIR "/tests/reference/fclib/";
  for (const char* name : {"columns", "rows", "triplets", "nzmax_too_small"}) {
    const FclibProblem file = read_fclib(seeds + name + ".hdf5");
    EXPECT_EQ(file.local.W.toDense(), (2.0 * Eigen::Matrix3d::Identity()).eval()) << name;
    EXPECT_EQ(file.impulses.value(), Vec3(0.5, 0.0, 0.0)) << name;
  }
  const std::pair<const char*, const char*> bad[] = {
      {"bad_m", "/fclib_local/W is 2000000000 x 3, but its vectors require 3 x 3"},
      {"bad_nz", "/fclib_local/W/p has 3 elements"},
      {"bad_huge",
       "/fclib_local/vectors/q declares 1000000000000 elements, but the file has only 0 bytes of data for "
       "it"},
      {"bad_external", "/fclib_local/vectors/q is stored in another file"},
      {"bad_link", "/fclib_local/W is a link: links are not followed"},
      {"bad_text", "/fclib_local/vectors/mu does not hold numbers"}};
  for (const auto& [name, phrase] : bad) {
    try {
      read_fclib(seeds + name + ".hdf5");
      ADD_FAILURE() << name << " is accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(phrase), std::string::npos) << error.what();
    }
  }
}

/// Writes the global form of libfclib, in columns.
void write_global(const std::string& path, Sparse M, Sparse H, VecX f, VecX w, VecX mu) {
  const auto matrix_of = [](Sparse& A) -> fclib_matrix {
    A.makeCompressed();
    return {static_cast<int>(A.nonZeros()),
            static_cast<int>(A.rows()),
            static_cast<int>(A.cols()),
            A.outerIndexPtr(),
            A.innerIndexPtr(),
            A.valuePtr(),
            -1,
            nullptr};
  };
  fclib_matrix M_file = matrix_of(M), H_file = matrix_of(H);
  fclib_global global{};
  global.M = &M_file;
  global.H = &H_file;
  global.mu = mu.data();
  global.f = f.data();
  global.w = w.data();
  global.spacedim = 3;
  ASSERT_NE(fclib_write_global(&global, path.c_str()), 0);
}

// Two point masses of 2 kg one on the other, pressed down by 2 N s each. The upper one is pushed by 1.5 N s,
// of which friction takes 0.5 * 2 N s: it slides at 0.5 / 2 m/s. The ground carries 4 N s and the friction, 1
// <= 0.6 * 4 N s. Both forces follow from equilibrium.
TEST(Fclib, SolvesAGlobalProblemWithAKnownSolution) {
  Sparse M(6, 6), H(6, 6);
  M.setIdentity();
  M *= 2.0;
  for (int k = 0; k < 6; ++k) H.insert(k, k) = 1.0;
  for (int k = 0; k < 3; ++k) H.insert(k, 3 + k) = -1.0;
  VecX f(6), impulses(6), velocities(6);
  f << -2.0, 0.0, 0.0, -2.0, 1.5, 0.0;
  impulses << 4.0, -1.0, 0.0, 2.0, -1.0, 0.0;
  velocities << 0.0, 0.0, 0.0, 0.0, 0.25, 0.0;
  const std::string path = temporary("global.hdf5");
  write_global(path, M, H, f, VecX::Zero(6), Eigen::Vector2d(0.6, 0.5));
  const FclibProblem file = read_fclib(path);
  std::filesystem::remove(path);
  EXPECT_TRUE(file.was_global);
  VecX gamma;
  const SolveSummary summary = solve_delassus(file.local, {}, &gamma);
  EXPECT_EQ(summary.ending, SolveEnding::converged) << summary.message;
  constexpr double kTolerance =
      1e-7;  // the merits are below 1e-9, times a condition number of at most 7 and 2 N s/(m/s)
  EXPECT_LE((gamma - impulses).norm(), kTolerance) << gamma.transpose();
  EXPECT_LE((file.local.W * gamma + file.local.q - velocities).norm(), kTolerance);
}

// Problems from other codes: full 3x3 blocks, no compliance, Coulomb's law; W of Capsules is unsymmetric by
// 1e-3.
TEST(Fclib, SolvesPublicProblems) {
  if (!std::filesystem::exists(shared_fclib())) GTEST_SKIP() << "no " << shared_fclib();
  int solved = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shared_fclib())) {
    const FclibProblem file = read_fclib(entry.path().string());
    VecX gamma;
    const SolveSummary summary = solve_delassus(file.local, {}, &gamma);
    EXPECT_EQ(summary.ending, SolveEnding::converged) << entry.path() << summary.message;
    EXPECT_LE(fclib_merit(file.local, gamma, FrictionLaw::coulomb), 1e-8) << entry.path();
    ++solved;
  }
  EXPECT_EQ(solved, 6);
}

}  // namespace
}  // namespace cupola::fclib_test
