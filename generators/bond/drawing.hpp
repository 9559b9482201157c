#pragma once

#include <vector>

#include "assembly/case/geometry.hpp"

namespace cupola {

/// A block of a drawing, up to its repetitions: a connected set of cells of one letter.
struct DrawnBlock {
  char letter = 0;
  int cells = 0;
  int width = 0, height = 0, wythes = 0;  ///< letters, courses and layers that it spans
};

/// The blocks of drawings that are repeated without end, one drawing per wythe, inside first. Cells of one
/// letter are connected through their faces along the course, across beds, and between wythes.
class BondDrawing {
 public:
  /// `layers`: at least one. Throws InputError for an infinite set of connected cells, naming its letter, and
  /// for several drawings of different size or shift, or of different letters or courses where they share one.
  explicit BondDrawing(std::vector<const DrawnBond*> layers);

  const std::vector<DrawnBlock>& blocks() const { return blocks_; }
  /// Index into blocks() of a cell of the infinite pattern; -1: empty.
  int block_of(int column, int row, int wythe) const { return block_of_[cell(column, row, wythe)]; }

 private:
  size_t cell(int column, int row, int wythe) const;
  void fill(int column, int row, int wythe);

  std::vector<const DrawnBond*> layers_;
  int columns_, rows_, shift_;
  std::vector<DrawnBlock> blocks_;
  std::vector<int> block_of_;  // (rows x columns x wythes)
};

}  // namespace cupola
