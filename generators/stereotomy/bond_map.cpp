#include "generators/stereotomy/bond_map.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/markup.hpp"
#include "generators/stereotomy/cell_grid.hpp"
#include "generators/stereotomy/shell.hpp"

namespace cupola {
namespace {

constexpr double kWidth = 1600.0;  // px
constexpr double kMargin = 30.0;   // px

const char* colour(const CellGrid& grid, int block) {
  const BondBlock& label = grid.bond.blocks[block];
  if (grid.is_support(block)) return "#b5b5b5";
  if (label.kind == BlockKind::herringbone) return label.truncated ? "#8c4a2f" : "#d9784b";
  if (label.member >= grid.num_wythes) return "#a9bf8c";
  const int row = grid.first_row(block);
  const auto [start, end] = slices_in_row(grid, block, row);
  for (int cut = start + 1; cut < end; ++cut)
    if (grid.is_corner(row, cut)) return "#7fa3c7";
  return label.truncated ? "#cdb891" : "#e8dcc8";
}

bool is_in_wythe(const CellGrid& grid, int block, int wythe) {
  return std::ranges::any_of(grid.cells[block], [&](int cell) { return cell % grid.num_wythes == wythe; });
}

struct Scale {
  double x, y, left, bottom;  // px per abscissa and per row; px of the origin
};

/// Draws one rectangle per run of rows with the same slices. A block across the seam is drawn at both ends.
void draw_block(const CellGrid& grid, int block, const Scale& scale, std::string* svg) {
  const auto draw = [&](int row_start, int row_end, double from, double to) {
    *svg += fmt::format("<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' fill='{}'/>\n",
                        scale.left + scale.x * from, scale.bottom - scale.y * row_end, scale.x * (to - from),
                        scale.y * (row_end - row_start), colour(grid, block));
  };
  for (int row = grid.first_row(block); row <= grid.last_row(block);) {
    const auto slices = slices_in_row(grid, block, row);
    int end = row + 1;
    while (end <= grid.last_row(block) && slices_in_row(grid, block, end) == slices) ++end;
    const double from = grid.abscissa(row, slices.first), to = grid.abscissa(row, slices.second);
    draw(row, end, from, to);
    if (grid.surface.closed && to > grid.surface.extent + 1e-9)
      draw(row, end, from - grid.surface.extent, to - grid.surface.extent);
    row = end;
  }
}

double panel_height(const Storey& storey) {
  const int rows = storey.surface.num_rows;
  return rows * std::clamp(800.0 / rows, 2.0, 60.0);
}

/// Draws a wythe in a panel whose lower edge lies at `bottom`, with its name above it unless that is empty.
void draw_wythe(const CellGrid& grid, int wythe, const std::string& name, double bottom, double panel,
                std::string* svg) {
  const SurfaceMap& surface = grid.surface;
  const Scale scale{(kWidth - 2.0 * kMargin) / surface.extent, panel / grid.num_rows, kMargin, bottom};
  if (!name.empty())
    *svg += fmt::format("<text x='{:.2f}' y='{:.2f}' font-family='sans-serif' font-size='16'>{}</text>\n",
                        kMargin, bottom - panel - 6.0, markup_text(name));
  *svg += "<g stroke='#3a3a3a' stroke-width='0.6' clip-path='url(#shell)'>\n";
  for (int block : grid.order)
    if (is_in_wythe(grid, block, wythe)) draw_block(grid, block, scale, svg);
  *svg += "</g>\n<g stroke='#1f3f66' stroke-width='1.2' stroke-dasharray='6 4'>\n";
  for (double corner : surface.corners)
    *svg += fmt::format("<line x1='{0:.2f}' x2='{0:.2f}' y1='{1:.2f}' y2='{2:.2f}'/>\n",
                        scale.left + scale.x * corner, bottom - panel, bottom);
  *svg += "</g>\n";
}

}  // namespace

std::string bond_map_svg(const Geometry& geometry) {
  if (geometry.imported)
    throw InputError("--bond-map: not available for imported blocks, which have no bond");
  const std::vector<Storey> storeys = make_storeys(geometry);
  double height = kMargin;
  for (const Storey& storey : storeys) height += storey.bond.num_wythes * (panel_height(storey) + kMargin);
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} "
      "{1:.0f}'>\n"
      "<defs><clipPath id='shell'><rect x='{2:.2f}' y='{2:.2f}' width='{3:.2f}' "
      "height='{4:.2f}'/></clipPath></defs>\n"
      "<rect width='100%' height='100%' fill='white'/>\n",
      kWidth, height, kMargin, kWidth - 2.0 * kMargin, height - 2.0 * kMargin);
  double bottom = height - kMargin;
  for (const Storey& storey : storeys) {
    const CellGrid grid = make_cell_grid(storey.surface, storey.bond, storey.stage_rings);
    for (int wythe = 0; wythe < grid.num_wythes; ++wythe) {
      const std::string name = storeys.size() > 1 || grid.num_wythes > 1 ? storey.members[wythe] : "";
      draw_wythe(grid, wythe, name, bottom, panel_height(storey), &svg);
      bottom -= panel_height(storey) + kMargin;
    }
  }
  return svg + "</svg>\n";
}

}  // namespace cupola
