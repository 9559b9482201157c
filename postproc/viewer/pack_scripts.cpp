// pack_scripts: compresses the scripts that every report contains, once, while Cupola is built.
//
//   pack_scripts HEADER SCRIPT...
//
// Writes a header with the text kPackedScripts.

#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "assembly/files/atomic_file.hpp"
#include "postproc/viewer/packed_text.hpp"

int main(int argc, char** argv) {
  using namespace cupola;
  try {
    std::string scripts;
    for (int i = 2; i < argc; ++i) {
      if (i > 2) scripts.push_back('\n');
      scripts += read_text(argv[i]);
    }
    write_text_atomically(argv[1],
                          fmt::format("#pragma once\n\nnamespace cupola {{\n\ninline constexpr const char* "
                                      "kPackedScripts = \"{}\";\n\n}}  // namespace cupola\n",
                                      packed_text(scripts)));
  } catch (const std::exception& error) {
    fmt::print(stderr, "pack_scripts: {}\n", error.what());
    return 1;
  }
  return 0;
}
