#pragma once

#include <cstddef>

namespace cupola {

/// Paces writing again what grows: it is due when it has grown by a hundredth since it was written, so that
/// the sum of all writing is proportional to its final size.
class Growth {
 public:
  bool is_due(std::size_t size) const { return size < written_ || 100 * (size - written_) >= size; }
  bool is_current(std::size_t size) const { return size == written_; }
  void written(std::size_t size) { written_ = size; }

 private:
  std::size_t written_ = 0;
};

}  // namespace cupola
