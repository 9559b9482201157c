// Checkpoints: raw bytes, and bytes after a valid first line and checksum, so that the checks of the archive
// itself are tested. Promise: an accepted checkpoint is written back as the same bytes.

#include "assembly/files/atomic_file.hpp"
#include "assembly/files/hash.hpp"
#include "solver/runtime/checkpoint.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace cupola {

bool reader_accepts(std::string_view bytes) {
  static const ScratchPath scratch("_checkpoint");
  const std::string& path = scratch.path;
  write_bytes(path, bytes);
  if (accepts([&] { read_checkpoint(path); })) return true;

  const std::string archive(bytes);
  const std::string text = "cupola checkpoint 1\n" + hash_text(archive) + archive;
  write_bytes(path, text);
  std::optional<Checkpoint> checkpoint;
  if (!accepts([&] { checkpoint = read_checkpoint(path); })) return false;
  demand(checkpoint.has_value(), "a checkpoint that is there is read");
  write_checkpoint(path, *checkpoint);
  demand(read_text(path) == text, "a checkpoint survives reading and writing");
  return true;
}

}  // namespace cupola
