#include "generators/importer/import_report.hpp"

#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/place_text.hpp"

namespace cupola {

std::vector<std::string> warnings_of(const ImportReport& r) {
  constexpr double kNoticeable = 0.01;  // of a volume
  std::vector<std::string> warnings;
  if (r.sliver_parts > 0)
    warnings.push_back(fmt::format("{}, thinner than 1e-3 of the size",
                                   counted(r.sliver_parts, "part is a sliver", "parts are slivers")));
  if (r.doubled_faces > 0)
    warnings.push_back(counted(r.doubled_faces, "face repeats", "faces repeat") +
                       " another one of the same block; the repetition is dropped");
  if (r.drawn_volume > 0.0 && std::abs(r.volume_of_parts / r.drawn_volume - 1.0) > kNoticeable)
    warnings.push_back(fmt::format(
        "the blocks have {:.4g} m3, and their drawing {:.4g} m3: warped faces were split into plane ones",
        r.volume_of_parts, r.drawn_volume));
  if (std::abs(r.most_changed) > kNoticeable)
    warnings.push_back(fmt::format(
        "block {} has {:.1f} % {} volume than its drawing: its warped faces were split into plane ones",
        r.origins[static_cast<size_t>(r.most_changed_block)].name, 100.0 * std::abs(r.most_changed),
        r.most_changed > 0.0 ? "more" : "less"));
  if (r.unusual_size > 0.0)
    warnings.push_back(fmt::format(
        "the blocks are {:.2g} m in size; if the file is not in metres, set geometry.import.metres_per_unit",
        r.unusual_size));
  if (!r.separate_solids.empty()) warnings.push_back(r.separate_solids);
  if (!r.doubt_of_axes.empty()) warnings.push_back(r.doubt_of_axes);
  return warnings;
}

std::string to_text(const ImportReport& r) {
  std::string text = fmt::format(
      "{} imported: {} already convex, {} split by planes, {} by their cross-section, "
      "{} by Nef polyhedra; largest relative volume error {:.1e}\n",
      counted(r.origins.size(), "block"), counted(r.already_convex, "piece"), r.by_planes, r.as_prisms,
      r.by_nef, r.largest_volume_error);
  const auto place = [extent = (r.high - r.low).maxCoeff()](double at) { return place_text(at, extent, 4); };
  text +=
      fmt::format("extents x {} to {} m, y {} to {} m, z {} to {} m; volume {:.6g} m3, as drawn {:.6g} m3\n",
                  place(r.low.x()), place(r.high.x()), place(r.low.y()), place(r.high.y()), place(r.low.z()),
                  place(r.high.z()), r.volume_of_parts, r.drawn_volume);
  if (r.courses.courses > 0)
    text += fmt::format("{} {}: {}\n", counted(r.courses.courses, "course"),
                        r.courses.of_file ? "as the file numbers them" : "found", r.courses.kind);
  else if (!r.courses.refusal.empty())
    text += fmt::format("no courses: {}\n", r.courses.refusal);
  constexpr int kListed = 10;
  int several = 0;
  for (size_t b = 0; b < r.origins.size(); ++b)
    if (r.parts[b] > 1 && ++several <= kListed)
      text += fmt::format("  block {}: {}\n", r.origins[b].name, counted(r.parts[b], "convex part"));
  if (several > kListed)
    text += fmt::format("  {} with several convex parts; --report lists all\n",
                        counted(several - kListed, "more block"));
  const bool of_gaps = r.snap_of_gaps && r.snap == *r.snap_of_gaps;
  const std::string moved = counted(r.snapped_facets, "facet") + " moved to common planes";
  if (r.flatness.relative_warp >= ImportReport::kRoundedWarp)
    text += fmt::format(
        "faces deviate from planes by up to {:.2g} m, {:.1g} of the size of their block; facet_angle = "
        "{:.2g} rad and snap = {:.2g} m{}: {}\n",
        r.flatness.warp, r.flatness.relative_warp, r.facet_angle, r.snap,
        of_gaps    ? ", for faces that gape or overlap by up to that"
        : r.chosen ? ", chosen from that"
                   : "",
        moved);
  else if (of_gaps)
    text += fmt::format(
        "faces that meet gape or overlap by up to {0:.2g} m; snap = {0:.2g} m, chosen from that: {1}\n",
        r.snap, moved);
  else if (r.snapped_facets > 0)
    text += moved + "\n";
  if (r.flatness.bent > 0)
    text += fmt::format("{} warped by more than 0.05 rad: counted as several triangles\n",
                        counted(r.flatness.bent, "face"));
  if (r.sliver_parts + r.by_nef > 0)
    text += fmt::format(
        "note: slivers and Nef polyhedra often mean that faces made of triangles are not quite plane; "
        "geometry.import.facet_angle is {:.2g} rad, a larger value joins them\n",
        r.facet_angle);
  if (r.ties > 0) text += counted(r.ties, "tie") + "\n";
  return text;
}

}  // namespace cupola
