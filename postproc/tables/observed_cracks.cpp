#include "postproc/tables/observed_cracks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "postproc/tables/csv_file.hpp"

namespace cupola {
namespace {

constexpr double kFullTurn = 360.0;  // deg

std::vector<ObservedPlace> read_places(const std::string& path) {
  const CsvFile csv = read_csv(path);
  const size_t azimuth = csv.column("azimuth_deg"), width = csv.column("width_m");
  std::vector<ObservedPlace> places;
  double sum = 0.0;
  for (size_t row = 0; row < csv.rows.size(); ++row) {
    ObservedPlace place;
    place.azimuth = csv.number(row, azimuth);
    place.width = csv.number(row, width);
    const bool known = std::isfinite(place.azimuth) && std::isfinite(place.width) && place.width >= 0.0;
    const bool follows = places.empty() || (place.azimuth > places.back().azimuth &&
                                            place.azimuth < places.front().azimuth + kFullTurn);
    if (!known || !follows)
      throw InputError(
          FileLocation{path, static_cast<int>(row) + 2, 1},
          "each row needs an azimuth_deg above that of the row before, all within one turn, and a "
          "width_m >= 0, where 0 means that no crack was seen");
    places.push_back(place);
    sum += place.width;
  }
  if (places.size() < 2 || sum == 0.0)
    throw InputError(FileLocation{path}, "must hold at least two places, and a crack at one of them");
  for (ObservedPlace& place : places) place.observed_share = place.width / sum;
  return places;
}

/// The sector of each place reaches half-way to its neighbours.
void set_sectors(std::vector<ObservedPlace>* places) {
  const size_t n = places->size();
  for (size_t i = 0; i < n; ++i) {
    const double before = (*places)[(i + n - 1) % n].azimuth - (i == 0 ? kFullTurn : 0.0);
    const double after = (*places)[(i + 1) % n].azimuth + (i + 1 == n ? kFullTurn : 0.0);
    (*places)[i].sector = 0.5 * (after - before) / kFullTurn;
  }
}

ObservedPlace& place_of(double azimuth_deg, std::vector<ObservedPlace>* places) {
  return *std::ranges::min_element(*places, {}, [&](const ObservedPlace& place) {
    return std::abs(std::remainder(azimuth_deg - place.azimuth, kFullTurn));
  });
}

}  // namespace

std::optional<CrackAgreement> crack_agreement(const Evaluation& e) {
  if (e.scene.postproc.observed.empty() || !at_rest(e)) return std::nullopt;
  CrackAgreement out{read_places(e.scene.postproc.observed)};
  set_sectors(&out.places);
  const ContactTable& c = e.last.frame.contacts;
  double volume = 0.0;
  for (int i = 0; i < c.size(); ++i) {
    const double gap = c.crack_opening.empty() ? c.gap[i] : c.crack_opening[i];
    const bool is_head = c.kind[i] == JointKind::head || c.kind[i] == JointKind::other;
    if (!is_head || c.normal_force[i] > 0.0 || gap <= e.last.joints.floor.length) continue;
    ObservedPlace& place = place_of(azimuth(c.point[i]) * kDegrees, &out.places);
    place.model_width = std::max(place.model_width, gap);
    place.model_volume += gap * c.area[i];
    volume += gap * c.area[i];
  }
  for (ObservedPlace& place : out.places) {
    place.model_share = volume > 0.0 ? place.model_volume / volume : 0.0;
    out.agreement += std::min(place.observed_share, place.model_share);
    out.by_chance += std::min(place.observed_share, place.sector);
  }
  return out;
}

// clang-format off: one line per column.

const Columns<ObservedPlace>& observed_columns() {
  using P = ObservedPlace;
  static const Columns<P> columns{
      {"azimuth_deg", "deg", "place at which a crack was looked for", &P::azimuth},
      {"observed_width_m", "m", "width seen there; 0: none", &P::width},
      {"model_width_m", "m", "widest gap of a head joint in the sector half-way to the next places",
       &P::model_width},
      {"model_volume_m3", "m3", "gap times area of the open points of its head joints", &P::model_volume},
      {"observed_share", "", "of the sum of the widths seen", &P::observed_share},
      {"model_share", "", "of the sum of the volumes", &P::model_share},
  };
  return columns;
}

// clang-format on

Table observed_table(const CrackAgreement& found) {
  return make_table(
      "observed",
      fmt::format("Cracks seen on the building: the model agrees by {:.2f}, evenly spread cracks by {:.2f}",
                  found.agreement, found.by_chance),
      observed_columns(), found.places);
}

}  // namespace cupola
