#include "postproc/tables/observed_cracks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/files/seen_cracks.hpp"

namespace cupola {
namespace {

constexpr double kFullTurn = 360.0;  // deg

std::vector<ObservedPlace> places_of(const std::vector<SeenCrack>& seen) {
  double sum = 0.0;
  for (const SeenCrack& crack : seen) sum += crack.width;
  std::vector<ObservedPlace> places;
  for (const SeenCrack& crack : seen)
    places.push_back({.azimuth = crack.azimuth, .width = crack.width, .observed_share = crack.width / sum});
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

/// The places nearest to an azimuth: one, or two that are as near.
std::vector<ObservedPlace*> places_near(double azimuth_deg, std::vector<ObservedPlace>* places) {
  constexpr double kAsNear = 1e-6;  // deg, far above the rounding of azimuths
  const auto distance = [&](const ObservedPlace& place) {
    return std::abs(std::remainder(azimuth_deg - place.azimuth, kFullTurn));
  };
  double least = kFullTurn;
  for (const ObservedPlace& place : *places) least = std::min(least, distance(place));
  std::vector<ObservedPlace*> nearest;
  for (ObservedPlace& place : *places)
    if (distance(place) <= least + kAsNear) nearest.push_back(&place);
  return nearest;
}

}  // namespace

std::optional<CrackAgreement> crack_agreement(const Evaluation& e) {
  if (e.scene.postproc.observed.empty() || !at_rest(e)) return std::nullopt;
  CrackAgreement out{places_of(read_seen_cracks(e.scene.postproc.observed))};
  set_sectors(&out.places);
  const ContactTable& c = e.last.frame.contacts;
  double volume = 0.0;
  for (int i = 0; i < c.size(); ++i) {
    const double gap = c.crack_opening.empty() ? c.gap[i] : c.crack_opening[i];
    const bool is_head = c.kind[i] == JointKind::head || c.kind[i] == JointKind::other;
    if (!is_head || c.normal_force[i] > 0.0 || gap <= e.last.joints.floor.length) continue;
    const double angle = azimuth(e.assembly, c.block_a[i], c.block_b[i], c.point[i]);
    const std::vector<ObservedPlace*> nearest = places_near(angle * kDegrees, &out.places);
    for (ObservedPlace* place : nearest) {
      place->model_width = std::max(place->model_width, gap);
      place->model_volume += gap * c.area[i] / static_cast<double>(nearest.size());
    }
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
