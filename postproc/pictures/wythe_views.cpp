#include <algorithm>
#include <array>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "postproc/pictures/view_parts.hpp"

namespace cupola {
namespace {

/// What a block is in the thickness of its drum or shell.
enum class WythePlace : std::uint8_t { inner, middle, outer, bonder };

WythePlace place_in_thickness(const Evaluation& e, int b) {
  const Block& block = e.assembly.blocks[b];
  const WytheRange& range = e.shell.wythes[b];
  if (range != WytheRange{block.member, block.member + 1}) return WythePlace::bonder;
  if (e.shell.innermost[range.from] == range.from) return WythePlace::inner;
  const bool outer = range.to == e.shell.num_wythes || e.shell.innermost[range.to] == range.to;
  return outer ? WythePlace::outer : WythePlace::middle;
}

Colour place_colour(const Evaluation& e, int b) {
  constexpr std::array kColours{kFlat, Colour{0.76, 0.74, 0.56}, Colour{0.78, 0.56, 0.40},
                                Colour{0.58, 0.65, 0.71}};
  const Block& block = e.assembly.blocks[b];
  if (block.fixed) return kSupport;
  return block.kind == BlockKind::herringbone ? kUpright
                                              : kColours[static_cast<size_t>(place_in_thickness(e, b))];
}

/// The names of the members that have blocks, with their colours.
std::string colour_text(const Evaluation& e) {
  std::array<std::string, 4> lists;
  std::vector<bool> listed(e.assembly.members.size(), false);
  bool upright = false;
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b) {
    const Block& block = e.assembly.blocks[b];
    upright = upright || block.kind == BlockKind::herringbone;
    if (block.fixed || listed[block.member]) continue;
    listed[block.member] = true;
    std::string& list = lists[static_cast<size_t>(place_in_thickness(e, static_cast<int>(b)))];
    list += fmt::format("{}{}", list.empty() ? "" : ", ", e.assembly.members[block.member]);
  }
  constexpr std::array kNames{"sand", "olive", "brown", "grey-blue"};
  std::string text;
  for (size_t i = 0; i < lists.size(); ++i)
    if (!lists[i].empty()) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", kNames[i], lists[i]);
  return fmt::format("{}{}", text, upright ? "; orange: upright blocks" : "");
}

/// Where a block stands, as seen: in a vault the angle from the middle of the view to the right, over a right
/// angle; else the place along x, from -1 to 1.
double place_of(const Evaluation& e, const Block& block, double half_length) {
  if (!is_vault(e)) return block.centroid.x() / half_length - 1.0;
  const Vec3 towards = -view_direction(e);
  return wrapped(azimuth(block.centroid) - azimuth(towards)) * kDegrees / 90.0;
}

}  // namespace

bool draw_cut_open(const Pictured& run, Painter* painter) {
  const Evaluation& e = run.e;
  if (e.shell.most_wythes() < 2) return false;
  double half_length = 0.0;
  for (const Block& block : e.assembly.blocks)
    if (!block.fixed) half_length = std::max(half_length, 0.5 * block.centroid.x());
  // The inner wythe and the bonders stay where outer ones are gone; farther to the right a vault is open.
  constexpr double kOuterEnd = -0.45, kInnerEnd = 0.4, kRightEnd = 1.2;
  Coloured blocks;
  for (size_t b = 0; b < run.blocks.size(); ++b) {
    const Block& block = e.assembly.blocks[b];
    const double place = place_of(e, block, half_length);
    const WythePlace layer = place_in_thickness(e, static_cast<int>(b));
    const bool gone = layer == WythePlace::inner || layer == WythePlace::bonder
                          ? is_vault(e) && place > kInnerEnd && place < kRightEnd
                          : place > kOuterEnd && place < kRightEnd;
    if (block.fixed || !gone) blocks.add(run.blocks[b], place_colour(e, static_cast<int>(b)));
  }
  blocks.paint(painter);
  painter->add_caption(fmt::format("Cut open; {}", colour_text(e)));
  painter->look(view_direction(e), e.up);
  return true;
}

bool draw_exploded(const Pictured& run, Painter* painter) {
  const Evaluation& e = run.e;
  if (e.shell.most_wythes() < 2) return false;
  double low = 0.0, high = 0.0;
  for (const Block& block : e.assembly.blocks) {
    low = std::min(low, block.centroid.dot(e.up));
    high = std::max(high, block.centroid.dot(e.up));
  }
  constexpr double kVault = 1.9, kWall = 0.5;  // heights of the model between the inner and the outer wythe
  const bool vault = is_vault(e);
  const double step = (vault ? kVault : kWall) * (high - low) / (e.shell.most_wythes() - 1);
  const std::vector<Vec3> shifts = shifts_by_wythe(e.assembly, e.shell);
  Coloured blocks;
  for (size_t b = 0; b < run.blocks.size(); ++b) {
    BlockSurface surface = run.blocks[b];
    const Vec3 shift = step * (vault ? Vec3(shifts[b].norm() * e.up) : shifts[b]);
    for (Vec3& p : surface.vertices) p += shift;
    blocks.add(surface, place_colour(e, static_cast<int>(b)));
  }
  blocks.paint(painter);
  painter->add_caption(fmt::format("Taken apart; {}", colour_text(e)));
  painter->look(view_direction(e), e.up);
  return true;
}

}  // namespace cupola
