#include "assembly/files/hash.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <new>

#include <fmt/format.h>
#include <xxhash.h>

#include "assembly/base/error.hpp"

namespace cupola {

Hash::Hash() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(state_);
}

Hash::~Hash() {
  XXH3_freeState(state_);
}

Hash& Hash::add_bytes(const void* data, std::size_t size) {
  if (size > 0) XXH3_128bits_update(state_, data, size);
  return *this;
}

std::string Hash::hex() const {
  const XXH128_hash_t digest = XXH3_128bits_digest(state_);
  return fmt::format("{:016x}{:016x}", digest.high64, digest.low64);
}

std::string hash_text(std::string_view text) {
  return Hash().add(text).hex();
}

std::string hash_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw InputError(FileLocation{path}, "cannot be read");
  Hash hash;
  std::array<char, 1 << 16> buffer{};
  while (const size_t size = std::fread(buffer.data(), 1, buffer.size(), file.get()))
    hash.add_bytes(buffer.data(), size);
  if (std::ferror(file.get())) throw SystemError(path + ": reading failed");
  return hash.hex();
}

}  // namespace cupola
