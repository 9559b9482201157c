#pragma once

#include <string>
#include <utility>

namespace cupola {

/// A block as a case names it: by its number in the assembly, or by its name in an imported file until
/// resolve_block_names() replaces that by the number.
struct BlockRef {
  BlockRef(int block_number = 0) : number(block_number) {}
  explicit BlockRef(std::string block_name) : name(std::move(block_name)) {}
  operator int() const { return number; }

  int number = 0;
  std::string name;  ///< "": the number counts
};

}  // namespace cupola
