// Entry point for libFuzzer (clang, preset `fuzz`).

#include "tests/fuzz/reader_under_test.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cupola::reader_accepts({reinterpret_cast<const char*>(data), size});
  return 0;
}
