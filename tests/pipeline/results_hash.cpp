// results_hash: hashes of the numeric results of runs.
//
// Two versions of the programs with bit-identical results give the same hashes, even if versions, messages,
// keys, file names or column names differ. Times, memory and numbers of threads are not included.
//
//   results_hash out/brunelleschi out/wall_small

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "assembly/files/assembly_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/files/hash.hpp"
#include "assembly/files/results_file.hpp"
#include "assembly/program/program.hpp"

namespace {

using namespace cupola;

template <class T>
std::span<const T> bytes_of(const std::vector<T>& values) {
  return values;
}

std::string hash_of(const Assembly& assembly) {
  Hash hash;
  hash.add(std::string_view(content_hash(assembly)));
  for (const Part& part : assembly.parts) hash.add(part.volume);
  for (const Block& block : assembly.blocks)
    hash.add(block.mass).add(bytes_of<double>({block.centroid.data(), block.centroid.data() + 3}));
  return hash.hex();
}

std::string hash_of(const Frame& frame) {
  const ContactTable& contacts = frame.contacts;
  const BlockTable& blocks = frame.blocks;
  Hash hash;
  hash.add(frame.time);
  for (const auto* values : {&contacts.joint, &contacts.block_a, &contacts.block_b, &contacts.ring})
    hash.add(bytes_of(*values));
  hash.add(bytes_of(contacts.kind));
  for (const auto* values : {&contacts.point, &contacts.normal, &contacts.force}) hash.add(bytes_of(*values));
  for (const auto* values : {&contacts.gap, &contacts.normal_force, &contacts.friction_use, &contacts.area,
                             &contacts.slip, &contacts.law_violation})
    hash.add(bytes_of(*values));
  for (const auto* values :
       {&blocks.position, &blocks.velocity, &blocks.angular_velocity, &blocks.displacement})
    hash.add(bytes_of(*values));
  hash.add(bytes_of(blocks.quaternion_wxyz));
  return hash.hex();
}

std::string hash_of(const Summary& s) {
  Hash hash;
  hash.add(s.status).add(s.blocks).add(s.free_blocks).add(s.joints).add(s.contacts).add(s.unknowns);
  for (const Vec3& v : {s.applied_load_N, s.support_reaction_N})
    hash.add(bytes_of<double>({v.data(), v.data() + 3}));
  for (const double number : {s.weight_N, s.time_step_s, s.max_penetration_m}) hash.add(number);
  for (const std::optional<double>& number :
       {s.momentum_residual, s.equilibrium_residual, s.inertia_share, s.contact_law_residual,
        s.certified_force_error.value, s.friction_cone_violation, s.max_displacement_m, s.max_speed_m_per_s})
    hash.add(number.value_or(-1.0));
  hash.add(s.slipping_contacts).add(s.steps).add(s.iterations);
  return hash.hex();
}

/// Hash of the numbers in a table of the postprocessor, in the order of rows and columns. Words are ignored.
std::string hash_of_table(const std::filesystem::path& file) {
  Hash hash;
  std::ifstream lines(file);
  std::string line, word;
  std::getline(lines, line);  // column names
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    while (std::getline(words, word, ',')) {
      char* end = nullptr;
      const double number = std::strtod(word.c_str(), &end);
      if (!word.empty() && *end == '\0') hash.add(number);
    }
  }
  return hash.hex();
}

std::string hash_of_run(const std::filesystem::path& folder) {
  const Assembly assembly = read_assembly(folder / "assembly.vtu");
  const ResultsReader results(folder / "results", content_hash(assembly));
  std::vector<std::string> hashes{hash_of(assembly), hash_of(results.summary())};
  for (int i = 0; i < static_cast<int>(results.times().size()); ++i)
    hashes.push_back(hash_of(results.read_frame(i)));
  std::vector<std::string> tables;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "post"))
    if (entry.path().extension() == ".csv") tables.push_back(hash_of_table(entry.path()));
  std::sort(tables.begin(), tables.end());  // independent of file names
  Hash hash;
  for (const std::string& part : hashes) hash.add(std::string_view(part));
  for (const std::string& part : tables) hash.add(std::string_view(part));
  return hash.hex();
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("results_hash", [&] {
    for (int i = 1; i < argc; ++i)
      fmt::print("{}  {}\n", hash_of_run(argv[i]), std::filesystem::path(argv[i]).filename().string());
    return argc > 1 ? ExitCode::done : ExitCode::bad_input;
  });
}
