// The built programs, run as a user runs them: messages, exit codes and files.

#include <algorithm>
#include <cstdlib>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/files/content_hash.hpp"
#include "assembly/files/mesh_file.hpp"
#include "assembly/files/summary_file.hpp"
#include "assembly/model/results.hpp"
#include "tests/pipeline/program_run.hpp"

namespace cupola::programs_test {
namespace {

const std::string kCases = CUPOLA_SOURCE_DIR "/cases/";
const std::string kWall = kCases + "wall_large.yaml";

void expect_one_line(const ProgramRun& run, const std::string& phrase) {
  EXPECT_EQ(run.code, 2) << run.out << run.err;
  EXPECT_NE(run.err.find(phrase), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

void solve_wall(const ProgramFolder& folder, const std::string& set = "") {
  ASSERT_EQ(folder.run("cupola-generate " + kWall + " --output assembly.vtu --quiet" + set).code, 0);
  ASSERT_EQ(
      folder.run("cupola-solve " + kWall + " --assembly assembly.vtu --output results --quiet" + set).code,
      0);
}

ProgramRun analyse(const ProgramFolder& folder, const std::string& results, const std::string& set = "") {
  return folder.run("cupola-post analyse " + kWall + " --assembly assembly.vtu --results " + results +
                    " --output post --quiet" + set);
}

TEST(Programs, AnswerHelpVersionSchemaAndCheck) {
  const ProgramFolder folder;
  for (const std::string program : {"cupola-generate", "cupola-solve", "cupola-post analyse"}) {
    EXPECT_NE(folder.run(program + " --help").out.find("Sample runs:"), std::string::npos);
    const std::string version = folder.run(program + " --version").out;
    EXPECT_TRUE(version.starts_with(program + " ")) << version;
    EXPECT_NE(version.find("; binary: GPL-3.0-or-later"), std::string::npos) << version;
    EXPECT_NE(folder.run(program + " --schema").out.find("joints.friction"), std::string::npos);
    const ProgramRun check = folder.run(program + " " + kWall + " --check");
    EXPECT_EQ(check.code, 0) << check.err;
  }
  EXPECT_TRUE(folder.contents().empty());
}

// OpenBLAS prints the name of its kernels when it is loaded. Those of SSE3 are for processors without AVX2,
// and for those that it does not know.
TEST(Programs, TheSolverUsesTheKernelsOfItsProcessor) {
#ifdef __x86_64__
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2";
  const ProgramFolder folder;
  const std::string cores = folder.run("OPENBLAS_VERBOSE=2 cupola-solve --version").err;
  const size_t last = cores.rfind("Core: ");
  ASSERT_NE(last, std::string::npos) << cores;
  EXPECT_EQ(cores.find("Prescott", last), std::string::npos) << cores;
  const std::string asked =
      folder.run("OPENBLAS_VERBOSE=2 OPENBLAS_CORETYPE=Prescott cupola-solve --version").err;
  EXPECT_EQ(asked, "Core: Prescott\n");
#else
  GTEST_SKIP() << "not x86";
#endif
}

TEST(Programs, BadUsageReturnsTwoWithOneLine) {
  const ProgramFolder folder;
  expect_one_line(folder.run("cupola-generate"), "CASE.yaml is missing");
  expect_one_line(folder.run("cupola-generate " + kWall), "--output is missing");
  expect_one_line(folder.run("cupola-generate " + kWall + " --outptu a.vtu"), "--outptu");
  expect_one_line(folder.run("cupola-solve " + kWall + " --output results"), "--assembly is missing");
  expect_one_line(folder.run("cupola-solve " + kWall + " --check --set"), "--set");
  expect_one_line(folder.run("cupola-solve " + kWall + " --check --set joints.friction=-1"), "must be >= 0");
  EXPECT_TRUE(folder.contents().empty());
}

TEST(Programs, SolveTheSmallestCase) {
  const ProgramFolder folder;
  solve_wall(folder);
  const Summary summary = summary_from_json(slurp(folder.file("results/summary.json")), "summary.json");
  EXPECT_EQ(summary.status, Status::stable);
  EXPECT_EQ(summary.free_blocks, 10);
  EXPECT_EQ(summary.accuracy.asked, 1e-8);
  EXPECT_LE(summary.accuracy.reached, 1e-8);
  // Closed form of springs in series, c sum F_bed / n_bed: 42.511635 mm.
  EXPECT_NEAR(summary.max_displacement_m.value(), 42.511635e-3, 1e-4 * 42.5e-3);
}

// Exit code 3 with the measure that was missed, which is not the momentum residual of a dual method.
TEST(Programs, NameTheAccuracyThatWasMissed) {
  const ProgramFolder folder;
  const std::string set =
      " --set analysis.type=dynamic --set analysis.method=spg --set analysis.max_iterations=5"
      " --set analysis.duration=0.02";
  ASSERT_EQ(folder.run("cupola-generate " + kWall + " --output assembly.vtu --quiet" + set).code, 0);
  const ProgramRun run =
      folder.run("cupola-solve " + kWall + " --assembly assembly.vtu --output results --verbose" + set);
  EXPECT_EQ(run.code, 3) << run.err;
  EXPECT_NE(run.out.find("undecided: 2 of 2 steps missed the tolerance 1.0e-08 of the force error bound"),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("Error of the contact forces of a step: "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("worst contact "), std::string::npos) << run.out;
}

TEST(Programs, StateThatRigidForcesMayNotBeUnique) {
  const ProgramFolder folder;
  const std::string set = " --set joints.compliance.normal=0 --set joints.compliance.tangential=0";
  solve_wall(folder, set);
  const ProgramRun run =
      folder.run("cupola-solve " + kWall + " --assembly assembly.vtu --output results --verbose" + set);
  EXPECT_NE(run.out.find("\n  The forces may not be unique: some joint compliance is zero"),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("No error bound is certified: some compliance is zero"), std::string::npos)
      << run.out;
  ASSERT_EQ(analyse(folder, "results", set).code, 0);
  EXPECT_NE(slurp(folder.file("post/report.html")).find("The forces may not be unique"), std::string::npos);
}

// A table that the case reads may have the name of one that the solver writes or removes.
TEST(Programs, DoNotReplaceAFileOfTheCase) {
  const ProgramFolder folder;
  std::ofstream(folder.file("history.csv")) << "0, 0\n1, 1\n";
  std::ofstream(folder.file("moved.yaml"))
      << "extends: cupola:arch\nanalysis: {type: dynamic, duration: 0.1}\n"
         "supports: {base_motion: {quantity: displacement, direction: [1, 0, 0], file: history.csv}}\n";
  ASSERT_EQ(folder.run("cupola-generate moved.yaml --output assembly.vtu --quiet").code, 0);
  const ProgramRun run = folder.run("cupola-solve moved.yaml --assembly assembly.vtu --output .");
  EXPECT_EQ(run.code, 2) << run.out;
  EXPECT_NE(run.err.find("history.csv: error: the run would replace this file"), std::string::npos)
      << run.err;
  EXPECT_EQ(slurp(folder.file("history.csv")), "0, 0\n1, 1\n");
}

TEST(Programs, WriteTheSameBytesEveryTime) {
  const ProgramFolder first, second;
  solve_wall(first);
  solve_wall(second);
  auto a = first.contents(), b = second.contents();
  for (auto* files : {&a, &b}) files->erase("work/results/summary.json");  // contains wall time and memory
  EXPECT_EQ(a, b);
}

// 1,280 blocks: the dense blocks of the factor are large enough for a multithreaded BLAS to split them.
TEST(Programs, WriteTheSameBytesOnOneAndTwoThreads) {
  const std::string dome = kCases + "dome_circular.yaml";
  std::map<std::string, std::string> files[2];
  for (const int threads : {1, 2}) {
    for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"})
      setenv(name, std::to_string(threads).c_str(), 1);
    const ProgramFolder folder;
    ASSERT_EQ(folder.run("cupola-generate " + dome + " --output assembly.vtu --quiet").code, 0);
    ASSERT_EQ(folder
                  .run("cupola-solve " + dome +
                       fmt::format(" --assembly assembly.vtu --output results --quiet --threads {}", threads))
                  .code,
              0);
    files[threads - 1] = folder.contents();
    files[threads - 1].erase("work/results/summary.json");  // contains wall time and memory
    files[threads - 1].erase("work/results/run.yaml");      // contains the number of threads
  }
  for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) unsetenv(name);
  EXPECT_GT(files[0].size(), 4u);
  EXPECT_EQ(files[0], files[1]);
}

TEST(Programs, RunYamlIsACaseOfTheSameModel) {
  const ProgramFolder folder;
  solve_wall(folder, " --set joints.friction=0.3 --set geometry.bond.rings=3");
  const ProgramRun again =
      folder.run("cupola-solve results/run.yaml --assembly assembly.vtu --output again --quiet");
  ASSERT_EQ(again.code, 0) << again.err;
  const auto hash = [&](const std::string& name) {
    return summary_from_json(slurp(folder.file(name + "/summary.json")), name).case_hash;
  };
  EXPECT_EQ(hash("results"), hash("again"));
}

TEST(Programs, RefuseADamagedAssemblyAndLeaveAllFiles) {
  const ProgramFolder folder;
  solve_wall(folder);
  const std::string assembly = slurp(folder.file("assembly.vtu"));
  std::ofstream(folder.file("truncated.vtu")) << assembly.substr(0, assembly.size() / 2);
  std::string edited = assembly;
  edited[edited.size() / 2] = edited[edited.size() / 2] == 'A' ? 'B' : 'A';
  std::ofstream(folder.file("edited.vtu")) << edited;
  std::ofstream(folder.file("empty.vtu"));
  std::ofstream(folder.file("text.vtu")) << "not an assembly\n";

  const auto before = folder.contents();
  const auto solve = [&](const std::string& file) {
    return folder.run("cupola-solve " + kWall + " --assembly " + file + " --output results");
  };
  expect_one_line(solve("truncated.vtu"), "truncated.vtu: error: ");
  expect_one_line(solve("edited.vtu"), "edited.vtu: error: is damaged or was edited");
  expect_one_line(solve("empty.vtu"), "empty.vtu: error: ");
  expect_one_line(solve("text.vtu"), "text.vtu: error: ");
  expect_one_line(solve("none.vtu"), "none.vtu: error: does not exist");
  expect_one_line(solve("results"), "results: error: ");
  expect_one_line(folder.run("cupola-solve " + kWall +
                             " --assembly assembly.vtu --output results --set geometry.bond.rings=3"),
                  "was not made from");
  EXPECT_EQ(folder.contents(), before);
}

TEST(Programs, AnalyseTheSmallestCase) {
  const ProgramFolder folder;
  solve_wall(folder);
  const ProgramRun run = analyse(folder, "results");
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* file : {"joints.vtp", "joints.csv", "rings.csv", "blocks.pvd", "summary.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.file(std::string("post/") + file))) << file;
}

TEST(Programs, ReportMissingFrames) {
  const ProgramFolder folder;
  const std::string motion =
      " --set analysis.type=dynamic --set analysis.duration=0.04 --set output.frames_every=0.01";
  solve_wall(folder, motion);
  std::filesystem::remove(folder.file("results/blocks_0001.vtp"));
  std::filesystem::remove(folder.file("results/contacts_0003.vtp"));
  std::filesystem::remove(folder.file("results/run.yaml"));
  const ProgramRun run = analyse(folder, "results", motion);
  ASSERT_EQ(run.code, 2) << run.err;
  const std::string report = slurp(folder.file("post/report.html"));
  for (const char* said : {"frame 1 was left out: ", "frame 3 was left out: ", "run.yaml was left out: "}) {
    EXPECT_NE(run.err.find(said), std::string::npos) << said << run.err;
    EXPECT_EQ(run.err.find(said), run.err.rfind(said)) << "said once";
    EXPECT_LT(report.find(said), report.find("<h2")) << said;
  }
}

TEST(Programs, RefuseResultsOfAnotherCaseAndLeaveAllFiles) {
  const ProgramFolder folder;
  solve_wall(folder, " --set geometry.surface.length=9");
  std::filesystem::rename(folder.file("results"), folder.file("other"));
  solve_wall(folder);
  ASSERT_EQ(analyse(folder, "results").code, 0);
  std::filesystem::copy(folder.file("results"), folder.file("cut"));
  const std::string contacts = slurp(folder.file("results/contacts_0000.vtp"));
  std::ofstream(folder.file("cut/contacts_0000.vtp")) << contacts.substr(0, contacts.size() / 2);
  std::filesystem::copy(folder.file("results"), folder.file("headless"));
  std::filesystem::remove(folder.file("headless/summary.json"));
  std::filesystem::copy(folder.file("results"), folder.file("unlisted"));
  std::ofstream(folder.file("unlisted/contacts.pvd")) << "<VTKFile";

  const auto before = folder.contents();
  expect_one_line(analyse(folder, "none"), "none");
  expect_one_line(analyse(folder, "other"), "other");
  expect_one_line(analyse(folder, "cut"), "contacts_0000.vtp: error: ");
  expect_one_line(analyse(folder, "headless"), "summary.json");
  expect_one_line(analyse(folder, "unlisted"), "contacts.pvd: error: ");
  expect_one_line(analyse(folder, "results", " --set geometry.surface.length=9"),
                  "was generated from another case");
  expect_one_line(analyse(folder, "results", " --set joints.friction=0.3"), "was solved from another case");
  expect_one_line(folder.run("cupola-post"), "the command is missing");
  expect_one_line(folder.run("cupola-post analise"), "unknown command `analise`");
  EXPECT_EQ(folder.contents(), before);
}

// Program, case, assembly, threads and residuals are stored in each file or, for text tables, in the summary
// beside it.
TEST(Programs, EveryFileStoresItsProvenance) {
  const ProgramFolder folder;
  solve_wall(folder);
  ASSERT_EQ(analyse(folder, "results").code, 0);
  const Summary summary = summary_from_json(slurp(folder.file("results/summary.json")), "summary.json");
  const Mesh assembly = read_mesh(folder.file("assembly.vtu"));
  EXPECT_EQ(assembly.field<std::string>("geometry_hash"), summary.geometry_hash);
  EXPECT_NE(assembly.field<std::string>("options").find("thickness: "), std::string::npos);
  int meshes = 0;
  for (const auto& [name, hash] : folder.contents()) {
    if (!name.ends_with(".vtu") && !name.ends_with(".vtp")) continue;
    const Mesh mesh = read_mesh(folder.file(std::filesystem::path(name).lexically_relative("work")));
    EXPECT_EQ(mesh.field<std::string>("program_version"), summary.program_version) << name;
    const std::string chained = name.ends_with("assembly.vtu") ? "content_hash" : "assembly_hash";
    EXPECT_EQ(mesh.field<std::string>(chained), summary.assembly_hash) << name;
    if (name.find("/post/") == std::string::npos) continue;
    EXPECT_EQ(mesh.field<std::string>("case_hash"), summary.case_hash) << name;
    EXPECT_EQ(mesh.field<std::int32_t>("threads"), summary.threads) << name;
    EXPECT_EQ(mesh.field<double>("equilibrium_residual"), summary.equilibrium_residual) << name;
    ++meshes;
  }
  EXPECT_EQ(meshes, 7) << "blocks, joints, joint forces, wrenches, thrust lines, sections, cracks";
  const std::string run_yaml = slurp(folder.file("results/run.yaml"));
  const std::string post = slurp(folder.file("post/summary.json")) + slurp(folder.file("post/report.html"));
  for (const std::string& said : {summary.program_version, summary.case_hash, summary.assembly_hash}) {
    EXPECT_NE(run_yaml.find(said), std::string::npos) << said;
    EXPECT_NE(post.find(said), post.rfind(said)) << said << ": in the summary and in the report";
  }
}

TEST(Programs, ForceAcceptsFilesOfAnotherCase) {
  const ProgramFolder folder;
  solve_wall(folder);
  const ProgramRun solved = folder.run("cupola-solve " + kWall +
                                       " --assembly assembly.vtu --output forced --quiet --force "
                                       "--set material.density=2000");
  EXPECT_EQ(solved.code, 0) << solved.err;
  EXPECT_NE(solved.err.find("warning"), std::string::npos) << solved.err;
  const ProgramRun drawn = analyse(folder, "results", " --force --set joints.friction=0.3");
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_NE(drawn.err.find("warning"), std::string::npos) << drawn.err;
  // Results of another assembly: first with the same number of blocks, then with fewer.
  const auto other = [&folder](const std::string& set) {
    EXPECT_EQ(folder.run("cupola-generate " + kWall + " --output other.vtu --quiet" + set).code, 0);
    const std::string call =
        "cupola-post analyse " + kWall + " --assembly other.vtu --results results --output post";
    expect_one_line(folder.run(call + set), "belongs to another assembly");
    return folder.run(call + " --quiet --force" + set);
  };
  const ProgramRun heavier = other(" --set material.density=2500");
  EXPECT_EQ(heavier.code, 0) << heavier.err;
  EXPECT_NE(heavier.err.find("the results belong to another assembly"), std::string::npos) << heavier.err;
  expect_one_line(other(" --set geometry.bond.rings=3"), "blocks and the assembly");
  // Keys that only affect figures need no new run.
  EXPECT_EQ(analyse(folder, "results", " --set postproc.sections=[1.5] --set title=other").code, 0);
}

TEST(Programs, AFailedRunKeepsTheOldAssembly) {
  const ProgramFolder folder;
  solve_wall(folder);
  const auto before = folder.contents();
  expect_one_line(
      folder.run("cupola-generate " + kWall + " --output assembly.vtu --set geometry.surface.length=-1"),
      "geometry.surface.length = -1: must be > 0");
  EXPECT_EQ(folder.contents(), before);
}

// Batch systems limit the address space. If OpenBLAS cannot allocate its buffers it retries for ever.
TEST(Programs, ReportTooLittleAddressSpace) {
#ifdef CUPOLA_SANITIZED
  GTEST_SKIP() << "sanitizers take all the address space";
#endif
  const ProgramFolder folder;
  solve_wall(folder);
  const auto fails = [&folder](const std::string& limit, const std::string& threads,
                               const std::string& phrase) {
    const ProgramRun run =
        folder.run("sh -c 'ulimit -v " + limit + "; ulimit -t 10; exec cupola-solve " + kWall +
                   " --assembly assembly.vtu --output r --threads " + threads + "'");
    EXPECT_EQ(run.code, 1) << run.err;
    EXPECT_NE(run.err.find("cupola-solve: error: out of memory: " + phrase), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  };
  fails("204800", "1", "144 MB of address space required for 1 thread");
  fails("700000", "100", "14400 MB of address space required for 100 threads");
}

// The stack of a second thread would need more than the whole address space. gnuplot may start its threads.
TEST(Programs, AnalyseWithoutASecondThread) {
#ifdef CUPOLA_SANITIZED
  GTEST_SKIP() << "sanitizers take all the address space";
#endif
  const ProgramFolder folder;
  std::ofstream(folder.file("gnuplot")) << "#!/bin/sh\nulimit -s 8192\nPATH=${PATH#.:} exec gnuplot \"$@\"\n";
  std::filesystem::permissions(folder.file("gnuplot"), std::filesystem::perms::owner_all);
  solve_wall(folder);
  ASSERT_EQ(analyse(folder, "results").code, 0);
  const auto with_a_thread = folder.contents();
  std::filesystem::remove_all(folder.file("post"));
  const ProgramRun run =
      folder.run("sh -c 'ulimit -s 4194304; ulimit -v 2097152; PATH=.:$PATH exec cupola-post analyse " +
                 kWall + " --assembly assembly.vtu --results results --output post --quiet'");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(folder.contents(), with_a_thread);
}

// OpenBLAS would start a thread for each further processor, which spins. The processors that the
// solver may use are those of the shell that started it.
TEST(Programs, SolveOnOneThreadThatMayUseAllProcessors) {
#ifdef CUPOLA_SANITIZED
  GTEST_SKIP() << "sanitizers start before the program can restrict OpenBLAS";
#endif
  const ProgramFolder folder;
  const std::string set =
      " --set analysis.type=dynamic --set analysis.duration=1000 --set output.frames_every=1000";
  ASSERT_EQ(folder.run("cupola-generate " + kWall + " --output assembly.vtu --quiet" + set).code, 0);
  const ProgramRun run = folder.run(
      "sh -c 'cupola-solve " + kWall + " --assembly assembly.vtu --output results --verbose" + set +
      " >log 2>&1 & until grep -q ^step log; do sleep 0.05; done; "
      "grep ^Threads: /proc/$!/status; grep ^Cpus_allowed: /proc/$!/status >solver; "
      "grep ^Cpus_allowed: /proc/$$/status >shell; kill -INT $!; wait $!'");
  EXPECT_EQ(run.code, 4) << slurp(folder.file("log"));
  EXPECT_EQ(run.out, "Threads:\t1\n");
  EXPECT_FALSE(slurp(folder.file("shell")).empty());
  EXPECT_EQ(slurp(folder.file("solver")), slurp(folder.file("shell")));
}

TEST(Programs, RefuseATruncatedRunYaml) {
  const ProgramFolder folder;
  solve_wall(folder);
  const std::string run_yaml = slurp(folder.file("results/run.yaml"));
  std::ofstream(folder.file("results/run.yaml")) << run_yaml.substr(0, run_yaml.size() / 2);
  expect_one_line(analyse(folder, "results"), "results/run.yaml: error: is damaged or was edited");
  EXPECT_TRUE(std::filesystem::exists(folder.file("post/report.html")));
}

TEST(Programs, ReportAFileThatCannotBeWritten) {
  const ProgramFolder folder;
  const ProgramRun run =
      folder.run("cupola-generate " + kWall + " --quiet --output /proc/nowhere/assembly.vtu");
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("/proc/nowhere"), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

TEST(Programs, ResumeAfterAnInterruptionBeforeTheFirstFrame) {
  const ProgramFolder folder;
  const std::string set =
      " --set analysis.type=dynamic --set analysis.duration=1000 --set output.frames_every=1000";
  ASSERT_EQ(folder.run("cupola-generate " + kWall + " --output assembly.vtu --quiet" + set).code, 0);
  const std::string solve =
      "cupola-solve " + kWall + " --assembly assembly.vtu --output results --verbose" + set;
  // Ctrl-C after the first steps; the first frame is due after 100,000 steps.
  const auto interrupted = [&folder](const std::string& command) {
    return folder.run("sh -c '" + command + " >log 2>&1 & until grep -q ^step log; do sleep 0.05; done; " +
                      "kill -INT $!; wait $!'");
  };
  EXPECT_EQ(interrupted(solve).code, 4) << slurp(folder.file("log"));
  EXPECT_TRUE(std::filesystem::exists(folder.file("results/checkpoint")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("results/summary.json")));
  std::filesystem::remove(folder.file("log"));
  EXPECT_EQ(interrupted(solve + " --resume").code, 4) << slurp(folder.file("log"));
  EXPECT_NE(slurp(folder.file("log")).find("resuming before the first frame"), std::string::npos)
      << slurp(folder.file("log"));
}

}  // namespace
}  // namespace cupola::programs_test
