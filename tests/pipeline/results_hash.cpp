// results_hash: one line per number that runs wrote, to be compared before and after a change.
//
//   results_hash out/net > after; diff before after
//
// A line is a hash of all values of one field of a frame, one key of a JSON file or one column of a CSV file:
// FOLDER/FILE COLUMN HASH. Two versions of the programs with bit-identical results print the same lines.
// Times, memory, versions, hashes of inputs and sentences are left out. The bits depend on the kernels that
// OpenBLAS chooses for the processor, which the first line names.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include <cblas.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "assembly/base/error.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/files/hash.hpp"
#include "assembly/files/results_file.hpp"
#include "assembly/program/program.hpp"

namespace {

using namespace cupola;
namespace fs = std::filesystem;

/// What differs between two runs of one program, or says which program and input it was.
bool is_left_out(const std::string& key) {
  for (const char* word : {"seconds", "solve_time", "memory", "threads", "version", "hash", "revision",
                           "message", "text_files", "warnings"})
    if (key.find(word) != std::string::npos) return true;
  return false;
}

void print(const std::string& place, const std::string& column, const std::string& hash) {
  fmt::print("{} {} {}\n", place, column, hash);
}

void print(const std::string& place, const std::string& column, const Hash& hash) {
  print(place, column, hash.hex());
}

template <class T>
void print_array(const std::string& place, const std::string& column, const std::vector<T>& values) {
  if (!values.empty()) print(place, column, Hash().add(std::span<const T>(values)));
}

void print_frame(const std::string& place, const Frame& frame) {
  const ContactTable& c = frame.contacts;
  print(place, "time", Hash().add(frame.time));
  print_array(place, "contacts.joint", c.joint);
  print_array(place, "contacts.block_a", c.block_a);
  print_array(place, "contacts.block_b", c.block_b);
  print_array(place, "contacts.kind", c.kind);
  print_array(place, "contacts.ring", c.ring);
  print_array(place, "contacts.point", c.point);
  print_array(place, "contacts.normal", c.normal);
  print_array(place, "contacts.gap", c.gap);
  print_array(place, "contacts.force", c.force);
  print_array(place, "contacts.normal_force", c.normal_force);
  print_array(place, "contacts.friction_use", c.friction_use);
  print_array(place, "contacts.area", c.area);
  print_array(place, "contacts.slip", c.slip);
  print_array(place, "contacts.law_violation", c.law_violation);
  print_array(place, "contacts.friction_limit", c.friction_limit);
  print_array(place, "contacts.strength_use", c.strength_use);
  print_array(place, "contacts.damage", c.damage);
  print_array(place, "contacts.crack_opening", c.crack_opening);
  print_array(place, "blocks.position", frame.blocks.position);
  print_array(place, "blocks.quaternion", frame.blocks.quaternion_wxyz);
  print_array(place, "blocks.velocity", frame.blocks.velocity);
  print_array(place, "blocks.angular_velocity", frame.blocks.angular_velocity);
  print_array(place, "blocks.displacement", frame.blocks.displacement);
  print_array(place, "ties.force", frame.ties.force);
  print_array(place, "ties.yielded", frame.ties.yielded);
}

/// Every number, word and truth value of a JSON file by its path; items of lists are counted.
void print_json(const std::string& place, const fs::path& file) {
  const nlohmann::json all = nlohmann::json::parse(std::ifstream(file)).flatten();
  for (const auto& [path, value] : all.items())
    if (!is_left_out(path)) print(place, path, hash_text(value.dump()));
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

void print_csv(const std::string& place, const fs::path& file) {
  std::ifstream lines(file);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<std::string> columns(names.size());
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of(line);
    for (size_t i = 0; i < std::min(cells.size(), columns.size()); ++i) columns[i] += cells[i] + ",";
  }
  for (size_t i = 0; i < names.size(); ++i)
    if (!is_left_out(names[i])) print(place, names[i], hash_text(columns[i]));
}

void print_run(const std::string& place, const fs::path& folder) {
  const Assembly assembly = read_assembly(folder / "assembly.vtu");
  print(place, "assembly", content_hash(assembly));
  Hash mass;
  for (const Part& part : assembly.parts) mass.add(part.volume);
  for (const Block& block : assembly.blocks)
    mass.add(block.mass).add(std::span<const double>(block.centroid.data(), 3));
  print(place, "masses", mass);
  const ResultsReader results(folder / "results", content_hash(assembly));
  for (int i = 0; i < static_cast<int>(results.times().size()); ++i)
    print_frame(fmt::format("{}/frame_{}", place, i), results.read_frame(i));
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("results_hash", [&] {
    if (argc != 2) throw InputError("one folder of runs is expected");
    fmt::print("kernels of OpenBLAS: {}\n", openblas_get_corename());
    std::map<std::string, fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(argv[1]))
      if (entry.is_regular_file()) files[fs::relative(entry.path(), argv[1])] = entry.path();
    for (const auto& [name, path] : files) {
      if (path.filename() == "assembly.vtu" && fs::exists(path.parent_path() / "results" / "summary.json"))
        print_run(fs::path(name).parent_path(), path.parent_path());
      if (path.extension() == ".json") print_json(name, path);
      if (path.extension() == ".csv") print_csv(name, path);
    }
    return ExitCode::done;
  });
}
