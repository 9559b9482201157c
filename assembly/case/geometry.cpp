#include "assembly/case/geometry.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace cupola {

VaultSurface::VaultSurface() = default;
VaultSurface::VaultSurface(const VaultSurface&) = default;
VaultSurface::VaultSurface(VaultSurface&&) noexcept = default;
VaultSurface& VaultSurface::operator=(const VaultSurface&) = default;
VaultSurface& VaultSurface::operator=(VaultSurface&&) noexcept = default;
VaultSurface::~VaultSurface() = default;

char DrawnBond::letter(int column, int row) const {
  const auto floor_division = [](int a, int b) { return (a >= 0 ? a : a - b + 1) / b; };
  const int num_rows = static_cast<int>(rows.size()), num_columns = static_cast<int>(rows.front().size());
  const int period = floor_division(row, num_rows);
  const int moved = column - shift * period;
  return rows[static_cast<size_t>(num_rows - 1 - (row - num_rows * period))]
             [static_cast<size_t>(moved - num_columns * floor_division(moved, num_columns))];
}

DrawnBond::LetterKind DrawnBond::kind_of(char letter) const {
  const auto found = std::ranges::find(kinds, letter, &std::pair<char, LetterKind>::first);
  return found == kinds.end() ? LetterKind::by_shape : found->second;
}

double Thickness::at(double height) const {
  if (constant() || height <= heights.front()) return values.front();
  const auto above = std::ranges::upper_bound(heights, height);
  if (above == heights.end()) return values.back();
  const auto i = static_cast<size_t>(above - heights.begin());
  const double fraction = (height - heights[i - 1]) / (heights[i] - heights[i - 1]);
  return values[i - 1] + fraction * (values[i] - values[i - 1]);
}

std::vector<const Member*> members_of(const Geometry& geometry) {
  std::vector<const Member*> members;
  for (const Member& member : geometry.members) members.push_back(&member);
  if (geometry.has_shell || members.empty()) members.push_back(&geometry);
  return members;
}

const Member* member_named(const Geometry& geometry, const std::string& name) {
  const std::vector<const Member*> members = members_of(geometry);
  if (name.empty()) return members.back();
  const Member* base = nullptr;  // of the stack, whose members are copied with it
  for (const Member* member : members) {
    if (member->name == name) return member;
    if (member->begins_stack()) base = member;
    for (int copy = 2; copy <= base->number_of_copies(); ++copy)
      if (name == fmt::format("{} {}", member->name, copy)) return member;
  }
  return nullptr;
}

std::string key_of_member(const Geometry& geometry, size_t i) {
  return i == geometry.members.size() ? "geometry" : fmt::format("geometry.members[{}]", i);
}

std::vector<const Bond*> bonds_of(const Masonry& masonry) {
  if (masonry.wythes.empty()) return {&masonry.bond};
  std::vector<const Bond*> bonds;
  for (const Wythe& wythe : masonry.wythes)
    if (wythe.bond) bonds.push_back(&*wythe.bond);
  return bonds;
}

const Bond* finest_bond(const Masonry& masonry) {
  const std::vector<const Bond*> bonds = bonds_of(masonry);
  if (bonds.empty()) return &masonry.bond;  // of a case that is not valid, or not complete yet
  return *std::ranges::max_element(bonds, {}, [](const Bond* bond) { return rings_of(*bond); });
}

int rings_of(const Bond& bond) {
  return std::visit([](const auto& b) { return b.rings * b.refine; }, bond);
}

}  // namespace cupola
