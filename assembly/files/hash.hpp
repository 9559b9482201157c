#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>

struct XXH3_state_s;

namespace cupola {

/// 128-bit hash of a stream of bytes (XXH3). It detects changes; it gives no protection against forgery.
class Hash {
 public:
  Hash();
  ~Hash();
  Hash(const Hash&) = delete;
  Hash& operator=(const Hash&) = delete;

  Hash& add_bytes(const void* data, std::size_t size);
  Hash& add(std::string_view text) { return add_bytes(text.data(), text.size()); }
  template <class T, std::size_t Extent>
  Hash& add(std::span<T, Extent> values) {
    return add_bytes(values.data(), values.size_bytes());
  }
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) Hash& add(T value) {
    return add_bytes(&value, sizeof value);
  }

  std::string hex() const;  ///< 32 hexadecimal digits

 private:
  XXH3_state_s* state_;
};

std::string hash_text(std::string_view text);
std::string hash_file(const std::string& path);

}  // namespace cupola
