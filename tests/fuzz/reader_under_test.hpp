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

/// What each fuzz target defines: reads the bytes as its kind of input and says whether they were accepted.
/// InputError is the only exception a reader may answer with; whatever else leaves this function, a crash, a
/// hang, or a broken promise about accepted input is a defect.
bool reader_accepts(std::string_view bytes);

/// Whether `read` ends without InputError.
template <class Read>
bool accepts(Read read) {
  try {
    read();
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Ends the program when a promise about accepted input is broken; active in every build, unlike an assert.
inline void demand(bool holds, const char* promise) {
  if (!holds) assertion_failed(promise, "accepted input", 0);
}

/// A file or folder of this process for readers that take a path, removed when the program ends.
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

/// Turns fuzzer bytes into choices, zeros when they run out.
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
