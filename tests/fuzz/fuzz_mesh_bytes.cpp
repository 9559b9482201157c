// assembly.vtu as raw bytes: damaged files. Promise: only intact files pass the checksum.

#include "assembly/files/assembly_file.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace cupola {

bool reader_accepts(std::string_view bytes) {
  static const ScratchPath scratch(".vtu");
  const std::string& path = scratch.path;
  write_bytes(path, bytes);
  return accepts([&] { read_assembly(path); });
}

}  // namespace cupola
