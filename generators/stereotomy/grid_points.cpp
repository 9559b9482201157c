#include "generators/stereotomy/grid_points.hpp"

#include <string>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {

double Random::uniform() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1.0p-53;
}

GridPoints::GridPoints(const CellGrid& grid, const std::optional<Imperfections>& imperfections,
                       const Eigen::Isometry3d& placement)
    : grid_(grid),
      placement_(placement),
      gap_(imperfections ? imperfections->gap : 0.0),
      noise_(imperfections ? imperfections->noise : 0.0),
      random_(imperfections ? imperfections->seed : 0),
      num_columns_(grid.surface.closed ? grid.num_slices : grid.num_slices + 1),
      num_layers_(grid.num_wythes + 1) {
  if (grid.num_wythes > 1 && (gap_ > 0.0 || noise_ > 0.0))
    throw InputError("imperfections: gap and noise are not available for a shell with wythes; remove them");
  if (grid.surface.key_stone && (gap_ > 0.0 || noise_ > 0.0))
    throw InputError(
        "imperfections: gap and noise are not available for a shell with a key stone; remove them");
  if (grid.bond.by_course() && (gap_ > 0.0 || noise_ > 0.0))
    throw InputError(
        "imperfections: gap and noise are not available for a bond with length: constant; remove them");
  bed_noise_.assign(grid.num_rows + 1, 0.0);
  cut_noise_.assign(num_columns_, 0.0);
  skin_noise_.assign(static_cast<size_t>(grid.num_rows + 1) * num_columns_ * num_layers_, 0.0);
  skin_fields_.resize(num_layers_);
  if (imperfections && imperfections->correlation_length) {
    const auto field = [&](const std::string& quantity) {
      return RandomField(imperfections->seed, quantity, *imperfections->correlation_length, 1.0);
    };
    gap_field_ = field("gap");
    bed_field_ = field("bed");
    cut_field_ = field("head");
    for (int layer = 0; layer < num_layers_; ++layer)
      skin_fields_[layer] = field(fmt::format("skin {}", layer));
  }
  if (noise_ == 0.0) return;
  for (int bed = 1; bed <= grid.num_rows - (grid.surface.carries ? 1 : 0); ++bed)
    bed_noise_[bed] = noise_ * symmetric(bed_field_, corner(bed, 0)) / metres_per_bed(bed, 0);
  for (int cut = 0; cut < num_columns_; ++cut)
    if (!grid.is_corner(0, cut))
      cut_noise_[cut] = noise_ * symmetric(cut_field_, corner(0, cut)) / metres_per_abscissa(0, cut);
  for (size_t k = 0; k < skin_noise_.size(); ++k) {
    const int layer = static_cast<int>(k) % num_layers_,
              column = static_cast<int>(k) / num_layers_ % num_columns_,
              bed = static_cast<int>(k) / num_layers_ / num_columns_;
    skin_noise_[k] = noise_ * symmetric(skin_fields_[layer], corner(bed, column));
  }
}

double GridPoints::uniform(const std::optional<RandomField>& field, const Vec3& place) {
  return field ? field->quantile_at(placement_ * place) : random_.uniform();
}

double GridPoints::symmetric(const std::optional<RandomField>& field, const Vec3& place) {
  return 2.0 * uniform(field, place) - 1.0;
}

Vec3 GridPoints::corner(int bed, int cut) const {
  return grid_.surface.intrados(bed, grid_.abscissa(0, cut));
}

double GridPoints::metres_per_bed(int bed, int cut) const {
  const int below = bed > 0 ? bed - 1 : 0;
  const double a = grid_.abscissa(0, cut);
  return (grid_.surface.intrados(below + 1, a) - grid_.surface.intrados(below, a)).norm();
}

double GridPoints::metres_per_abscissa(int bed, int cut) const {
  const int left = cut + 1 < num_columns_ || grid_.surface.closed ? cut : cut - 1;
  const double a = grid_.abscissa(0, left), b = grid_.abscissa(0, left + 1);
  return (grid_.surface.intrados(bed, b) - grid_.surface.intrados(bed, a)).norm() / (b - a);
}

std::vector<double> GridPoints::cuts_at_supports() const {
  std::vector<double> cuts = grid_.bond.cuts_of(0);
  for (size_t i = 0; i < cuts.size(); ++i) cuts[i] += cut_noise_[i % static_cast<size_t>(num_columns_)];
  return cuts;
}

Plane GridPoints::bed_plane(int bed, int row, int slice) const {
  const SurfaceMap& surface = grid_.surface;
  const double b = bed + bed_noise_[bed], a = grid_.abscissa(row, slice);
  const Vec3 foot = surface.intrados(b, a), out = surface.extrados(b, a) - foot;
  const Vec3 normal = out.cross(surface.intrados(b, grid_.abscissa(row, slice + 1)) - foot).normalized();
  return {normal, normal.dot(foot)};
}

Plane GridPoints::head_plane(int row, int top, int cut, double shift) const {
  const SurfaceMap& surface = grid_.surface;
  const int column = grid_.wrap(row, cut);
  const double a = grid_.abscissa(row, column) + cut_noise_[column] + shift;
  const Vec3 foot = surface.intrados(row, a), up = surface.intrados(top, a) - foot;
  const Vec3 normal = up.cross(surface.extrados(row, a) - foot).normalized();
  return {normal, normal.dot(foot)};
}

Vec3 GridPoints::point(double bed_shift, const Plane* head, int towards, int row, int bed, int cut,
                       int layer) const {
  const double b = bed + bed_noise_[bed] + bed_shift;
  const auto at_cut = [&](int c, int l) {
    const int column = grid_.wrap(row, c);
    return grid_.surface.point(b, grid_.abscissa(row, column) + cut_noise_[column], l);
  };
  const auto at = [&](int l) -> Vec3 {
    const Vec3 from = at_cut(cut, l);
    if (!head) return from;
    const Vec3 chord = at_cut(towards, l) - from;
    return from + (head->offset - head->normal.dot(from)) / head->normal.dot(chord) * chord;
  };
  if (noise_ == 0.0) return at(layer);
  const Vec3 across = at(grid_.num_wythes) - at(0);
  const size_t corner =
      (static_cast<size_t>(bed) * num_columns_ + grid_.wrap(row, cut)) * num_layers_ + layer;
  return at(layer) + skin_noise_[corner] * across.normalized();
}

bool GridPoints::bulges_along_rising_diagonal(int row, int cut) const {
  const Vec3 origin = corner(row, cut);
  const Vec3 right = corner(row, cut + 1) - origin, up = corner(row + 1, cut) - origin;
  const Vec3 opposite = corner(row + 1, cut + 1) - origin;
  // The height of the far corner above the plane of the other three, outwards.
  return right.cross(up).dot(opposite) >= 0.0;
}

void GridPoints::append(const Vec3& point, int bed, int layer, Assembly* assembly) const {
  if (!assembly->members.empty()) {
    assembly->vertex_layers.resize(assembly->vertices.size(), -1);  // corners of supports
    assembly->vertex_depths.resize(assembly->vertices.size(), 0.0);
    assembly->vertex_layers.push_back(first_layer_ + layer);
    assembly->vertex_depths.push_back(grid_.surface.depth(bed, layer) /
                                      grid_.surface.depth(bed, num_layers_ - 1));
  }
  assembly->vertices.push_back(point);
}

void GridPoints::make_shared(int first_layer, Assembly* assembly) {
  first_layer_ = first_layer;
  if (gap_ > 0.0) return;
  first_vertex_ = static_cast<int>(assembly->vertices.size());
  const int rows = grid_.surface.rows_per_ring;
  const auto append_beds = [&](int row, int first_bed, int last_bed) {
    const int columns = grid_.bond.by_course() ? grid_.slices_of(row) : num_columns_;
    for (int bed = first_bed; bed <= last_bed; ++bed)
      for (int column = 0; column < columns; ++column)
        for (int layer = 0; layer < num_layers_; ++layer)
          append(point(0.0, nullptr, column, row, bed, column, layer), bed, layer, assembly);
  };
  if (!grid_.bond.by_course()) return append_beds(0, 0, grid_.num_rows);
  for (int row = 0; row < grid_.num_rows; row += rows) {
    course_start_.push_back(static_cast<int>(assembly->vertices.size()) - first_vertex_);
    append_beds(row, row, row + rows);
  }
}

void GridPoints::start_block(int bond_block) {
  if (gap_ == 0.0) return;
  own_.clear();
  const int row = grid_.first_row(bond_block);
  const auto [left, right] = slices_in_row(grid_, bond_block, row);
  const int top = grid_.last_row(bond_block) + 1;
  const auto opening = [&](const Vec3& from, const Vec3& to) {  // m
    return 0.5 * gap_ * uniform(gap_field_, 0.5 * (from + to));
  };
  sides_ = {row, top, left, right, 0, 0, {}, {}};
  sides_.lower_gap = opening(corner(row, left), corner(row, right)) / metres_per_bed(row + 1, left);
  sides_.upper_gap = opening(corner(top, left), corner(top, right)) / metres_per_bed(top, left);
  const double left_gap = opening(corner(row, left), corner(top, left)) / metres_per_abscissa(row, left);
  const double right_gap =
      opening(corner(row, right), corner(top, right)) / metres_per_abscissa(row, right - 1);
  if (sides_.lower_gap + sides_.upper_gap >= top - row || left_gap + right_gap >= right - left)
    throw InputError(
        fmt::format("imperfections.gap = {}: opens joints by the size of a block; reduce it", gap_));
  sides_.left_head = head_plane(row, top, left, left_gap);
  sides_.right_head = head_plane(row, top, right, -right_gap);
}

int GridPoints::vertex(int row, int bed, int cut, int layer, Assembly* assembly) {
  CUPOLA_ASSERT(bed >= 0 && bed <= grid_.num_rows);
  if (grid_.bond.by_course()) {
    const int ring = grid_.ring_index(row), from_first = bed - ring * grid_.surface.rows_per_ring;
    return first_vertex_ + course_start_[ring] +
           (from_first * grid_.slices_of(row) + grid_.wrap(row, cut)) * num_layers_ + layer;
  }
  if (gap_ == 0.0) return first_vertex_ + (bed * num_columns_ + grid_.wrap(row, cut)) * num_layers_ + layer;
  const auto [it, is_new] = own_.try_emplace({bed, cut, layer}, static_cast<int>(assembly->vertices.size()));
  if (!is_new) return it->second;
  const double bed_shift = bed == sides_.lower   ? sides_.lower_gap
                           : bed == sides_.upper ? -sides_.upper_gap
                                                 : 0.0;
  const bool is_left = cut == sides_.left;
  const Plane* head = is_left ? &sides_.left_head : cut == sides_.right ? &sides_.right_head : nullptr;
  append(point(bed_shift, head, is_left ? cut + 1 : cut - 1, row, bed, cut, layer), bed, layer, assembly);
  return it->second;
}

}  // namespace cupola
