#include "generators/bond/drawing.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Column, row and wythe in the infinite pattern.
using LetterPlace = std::array<int, 3>;

int floor_of(int a, int b) {
  return (a >= 0 ? a : a - b + 1) / b;
}

int extent_of(const std::vector<LetterPlace>& places, size_t axis) {
  const auto [low, high] = std::ranges::minmax(places, {}, [axis](const LetterPlace& p) { return p[axis]; });
  return high[axis] - low[axis] + 1;
}

/// True if letters at one place of two drawings lie side by side in the masonry.
bool lie_side_by_side(const DrawnBond& a, const DrawnBond& b) {
  return a.letter_length == b.letter_length && a.length == b.length && a.phase == b.phase &&
         a.rings == b.rings && a.refine == b.refine;
}

}  // namespace

BondDrawing::BondDrawing(std::vector<const DrawnBond*> layers)
    : layers_(std::move(layers)),
      columns_(static_cast<int>(layers_.front()->rows.front().size())),
      rows_(static_cast<int>(layers_.front()->rows.size())),
      shift_(layers_.front()->shift) {
  for (const DrawnBond* layer : layers_)
    if (static_cast<int>(layer->rows.size()) != rows_ || layer->shift != shift_ ||
        static_cast<int>(layer->rows.front().size()) != columns_)
      throw InputError(
          "bond.rows: drawings of wythes side by side must have the same number of rows and letters, and the "
          "same shift, because a letter that they share at one place is one block");
  block_of_.assign(static_cast<size_t>(columns_) * rows_ * layers_.size(), -2);
  for (int wythe = 0; wythe < static_cast<int>(layers_.size()); ++wythe)
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column)
        if (block_of(column, row, wythe) == -2) fill(column, row, wythe);
}

/// Of the cell of the period that stands for a place in the infinite pattern.
size_t BondDrawing::cell(int column, int row, int wythe) const {
  const int period = floor_of(row, rows_), moved = column - shift_ * period;
  const auto c = static_cast<size_t>(moved - columns_ * floor_of(moved, columns_));
  const auto r = static_cast<size_t>(row - rows_ * period);
  return (static_cast<size_t>(wythe) * static_cast<size_t>(rows_) + r) * static_cast<size_t>(columns_) + c;
}

/// Finds the block of a place. If its cells reach a second place that stands for the same cell of the period,
/// they go on without end.
void BondDrawing::fill(int column, int row, int wythe) {
  const auto letter_at = [&](const LetterPlace& p) {
    return layers_[static_cast<size_t>(p[2])]->letter(p[0], p[1]);
  };
  std::vector<LetterPlace> places{{column, row, wythe}};
  const char letter = letter_at(places.front());
  const int id = letter == '.' ? -1 : static_cast<int>(blocks_.size());
  if (id < 0) {
    block_of_[cell(column, row, wythe)] = id;
    return;
  }
  std::map<size_t, LetterPlace> reached{{cell(column, row, wythe), places.front()}};
  for (size_t i = 0; i < places.size(); ++i)
    for (size_t axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        LetterPlace next = places[i];
        next[axis] += step;
        if (next[2] < 0 || next[2] >= static_cast<int>(layers_.size()) || letter_at(next) != letter) continue;
        if (next[2] != places[i][2] && !lie_side_by_side(*layers_[static_cast<size_t>(places[i][2])],
                                                         *layers_[static_cast<size_t>(next[2])]))
          throw InputError(fmt::format(
              "geometry.wythes: the letter {} is in two wythes side by side, as one block, so "
              "that their bonds must have the same letter_length, length, phase, rings and refine",
              letter));
        const auto [known, is_new] = reached.try_emplace(cell(next[0], next[1], next[2]), next);
        if (is_new)
          places.push_back(next);
        else if (known->second != next)
          throw InputError(fmt::format(
              "geometry.bond.rows: the letter {} goes on without end where the drawing is repeated; give "
              "neighbouring blocks different letters",
              letter));
      }
  for (const auto& [cell_of_period, place] : reached) block_of_[cell_of_period] = id;
  blocks_.push_back({letter, static_cast<int>(places.size()), extent_of(places, 0), extent_of(places, 1),
                     extent_of(places, 2)});
}

}  // namespace cupola
