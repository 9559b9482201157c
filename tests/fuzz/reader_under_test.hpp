#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

#include "assembly/base/error.hpp"

namespace cupola {

/// Defined by each fuzz target: reads the bytes as its kind of input and returns whether they were accepted.
/// A reader may throw only InputError. Any other exception, a crash, a hang, or a broken promise about
/// accepted input is a defect.
bool reader_accepts(std::string_view bytes);

/// True if `read` returns without InputError.
template <class Read>
bool accepts(Read read) {
  try {
    read();
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Aborts if a promise about accepted input is broken; unlike an assertion, active in every build.
inline void demand(bool holds, const char* promise) {
  if (!holds) assertion_failed(promise, "accepted input", 0);
}

/// A file or folder of this process, for readers that take a path; removed at exit.
struct ScratchPath {
  explicit ScratchPath(const std::string& ending)
      : path((std::filesystem::temp_directory_path() / ("cupola_fuzz_" + std::to_string(::getpid()) + ending))
                 .string()) {}
  ~ScratchPath() { std::filesystem::remove_all(path); }
  ScratchPath(const ScratchPath&) = delete;
  ScratchPath& operator=(const ScratchPath&) = delete;

  const std::string path;
};

inline void write_bytes(const std::string& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// Turns fuzzer bytes into choices; zeros after the last byte.
class ByteSource {
 public:
  explicit ByteSource(std::string_view bytes) : bytes_(bytes) {}
  bool empty() const { return bytes_.empty(); }
  template <class T>
  T take() {
    T value{};
    const size_t size = std::min(sizeof value, bytes_.size());
    std::memcpy(&value, bytes_.data(), size);
    bytes_.remove_prefix(size);
    return value;
  }
  size_t index(size_t size) { return size == 0 ? 0 : take<std::uint32_t>() % size; }

 private:
  std::string_view bytes_;
};

}  // namespace cupola
