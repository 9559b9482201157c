// ParaView collections (.pvd) as text.

#include "assembly/files/mesh_file.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace cupola {

bool reader_accepts(std::string_view bytes) {
  static const ScratchPath scratch(".pvd");
  const std::string& path = scratch.path;
  write_bytes(path, bytes);
  return accepts([&] { read_pvd(path); });
}

}  // namespace cupola
