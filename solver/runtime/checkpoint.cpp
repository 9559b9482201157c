#include "solver/runtime/checkpoint.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/byte_archive.hpp"
#include "assembly/files/hash.hpp"

namespace cupola {
namespace {

constexpr const char* kFirstLine = "cupola checkpoint 1\n";
constexpr std::size_t kHashDigits = 32;

template <class Archive>
void visit(Archive& archive, Checkpoint& x) {
  archive(x.program_version, x.case_hash, x.assembly_hash, x.frame_times, x.history, x.analysis);
}

}  // namespace

// Format: first line, hash of the archive in hexadecimal, bytes of the archive.
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint) {
  Checkpoint copy = checkpoint;
  ByteWriter archive;
  visit(archive, copy);
  write_text_atomically(path, kFirstLine + hash_text(archive.bytes()) + archive.bytes());
}

std::optional<Checkpoint> read_checkpoint(const std::string& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const std::string text = read_text(path);
  const std::string first_line = kFirstLine;
  const FileLocation where{path, 0, 0};
  if (text.compare(0, first_line.size(), first_line) != 0)
    throw InputError(where, "is not a checkpoint of this version; remove it to start from the beginning");
  const std::string bytes = text.size() < first_line.size() + kHashDigits
                                ? std::string()
                                : text.substr(first_line.size() + kHashDigits);
  if (hash_text(bytes) != text.substr(first_line.size(), kHashDigits))
    throw InputError(where, "is damaged: its checksum does not match; remove it to start from the beginning");
  Checkpoint checkpoint;
  try {
    ByteReader archive(bytes);
    visit(archive, checkpoint);
    if (!archive.at_end()) throw std::runtime_error("has extra bytes at its end");
  } catch (const std::runtime_error& error) {
    throw InputError(where,
                     fmt::format("is damaged: it {}; remove it to start from the beginning", error.what()));
  }
  return checkpoint;
}

}  // namespace cupola
