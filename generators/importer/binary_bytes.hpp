#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

#include "assembly/base/error.hpp"

namespace cupola {

/// Reads consecutive numbers of either byte order.
class BinaryBytes {
 public:
  BinaryBytes(const std::string& path, const std::string& bytes, size_t start, bool big_endian)
      : path_(path),
        bytes_(bytes),
        position_(start),
        swap_((std::endian::native == std::endian::big) != big_endian) {}

  template <class T>
  T take() {
    if (position_ + sizeof(T) > bytes_.size())
      throw InputError(FileLocation{path_}, "the file ends early, its header declares more data");
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + position_, sizeof(T));
    if (swap_) std::ranges::reverse(raw);
    position_ += sizeof(T);
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }
  size_t bytes_left() const { return bytes_.size() - position_; }

 private:
  const std::string& path_;
  const std::string& bytes_;
  size_t position_;
  bool swap_;
};

}  // namespace cupola
