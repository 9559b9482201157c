#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/export/arrows.hpp"
#include "postproc/mechanics/stage_blocks.hpp"
#include "postproc/pictures/view_parts.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "postproc/tables/mesh_parts.hpp"

namespace cupola {
namespace {

const std::vector<Colour> kSequential{
    {0.99, 0.91, 0.65}, {0.96, 0.70, 0.42}, {0.87, 0.43, 0.37}, {0.63, 0.20, 0.41}, {0.27, 0.07, 0.36}};
const std::vector<Colour> kDiverging{
    {0.70, 0.09, 0.17}, {0.96, 0.65, 0.51}, {0.96, 0.96, 0.96}, {0.57, 0.77, 0.87}, {0.13, 0.40, 0.67}};

/// True for blocks behind the vertical plane through the axis, seen along the view.
bool is_behind(const Pictured& run, int block) {
  return run.e.assembly.blocks[block].centroid.dot(view_direction(run.e)) > 0.0;
}

template <class ColourOf, class Shown>
void paint_blocks(const Pictured& run, const ColourOf& colour_of, const Shown& shown, Painter* painter) {
  Coloured blocks;
  for (size_t b = 0; b < run.blocks.size(); ++b)
    if (shown(static_cast<int>(b))) blocks.add(run.blocks[b], colour_of(static_cast<int>(b)));
  blocks.paint(painter);
}

bool every_block(int) {
  return true;
}

/// The next round number of at least two digits: 517 becomes 600.
double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (step * power >= value) return step * power;
  return 10.0 * power;
}

/// Symmetric about zero if there are values of both signs, else from zero. One value in a hundred at each end
/// is beyond.
ColourScale scale_of(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return {kSequential, 0.0, 1.0};
  std::sort(values.begin(), values.end());
  const size_t rim = values.size() / 100;
  const double low = values[rim], high = values[values.size() - 1 - rim];
  ColourScale scale{kSequential, low < 0.0 ? -round_up(-low) : 0.0, high > 0.0 ? round_up(high) : 0.0};
  if (low < 0.0 && high > 0.0) {
    scale = {kDiverging, -std::max(-scale.low, scale.high), std::max(-scale.low, scale.high)};
  } else if (low == 0.0 && high == 0.0) {
    scale.high = 1.0;
  }
  scale.below = values.front() < scale.low;
  scale.above = values.back() > scale.high;
  return scale;
}

/// What the colours of the bond mean, as far as the model has them.
std::string bond_text(const Evaluation& e) {
  const auto has = [&e](const auto& is) {
    return std::any_of(e.assembly.blocks.begin(), e.assembly.blocks.end(), is);
  };
  const bool upright = has([](const Block& b) { return b.kind == BlockKind::herringbone; });
  const bool corner = has([](const Block& b) { return b.rib && !b.fixed; });
  return fmt::format("Bond{}{}", upright ? "; orange: upright blocks" : "",
                     corner ? "; brown: blocks across a corner" : "");
}

/// Left the bond, right the hoop force of a vault at rest.
bool draw_overview(const Pictured& run, Painter* painter) {
  const Evaluation& e = run.e;
  const bool hoop = is_vault(e) && at_rest(e);
  if (hoop) painter->new_view(0.0, 0.5);
  paint_blocks(
      run, [&](int b) { return bond_colour(e.assembly.blocks[b]); }, every_block, painter);
  if (hoop) painter->add_caption(bond_text(e));
  painter->look(view_direction(e), e.up);
  if (!hoop) return true;
  painter->new_view(0.5, 1.0);
  std::vector<double> forces;
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b)
    forces.push_back(e.assembly.blocks[b].fixed ? std::numeric_limits<double>::quiet_NaN()
                                                : e.last.fields[b].hoop_force);
  const ColourScale scale = scale_of(forces);
  paint_blocks(
      run, [&](int b) { return scale.at(forces[b]); }, every_block, painter);
  painter->add_legend("Hoop force, kN/m (tension negative)", scale, 1e3);
  painter->look(view_direction(e), e.up);
  return true;
}

/// The half of a vault behind its axis.
bool draw_inside(const Pictured& run, Painter* painter) {
  if (!is_vault(run.e) || run.e.scene.geometry.window)
    return false;  // the overview shows a window from inside
  paint_blocks(
      run, [&](int b) { return bond_colour(run.e.assembly.blocks[b]); },
      [&](int b) { return is_behind(run, b); }, painter);
  painter->look(Vec3(0.35, 1.0, -0.12), run.e.up);
  return true;
}

/// The force of every joint on its upper block, or on the second one.
bool draw_forces(const Pictured& run, Painter* painter) {
  const Evaluation& e = run.e;
  if (!at_rest(e)) return false;
  std::vector<double> magnitudes;
  double largest = 0.0;
  for (const JointWrench& joint : e.last.joints.wrenches)
    if (!joint.negligible) magnitudes.push_back(joint.wrench.force.norm());
  if (magnitudes.empty()) return false;
  largest = *std::max_element(magnitudes.begin(), magnitudes.end());
  const ColourScale scale = scale_of(magnitudes);
  // Large blocks have few joints, whose arrows would be short beside them: the longest is at least a tenth of
  // the model.
  const double size = model_size(e.assembly);
  const double length = std::max(common_scale(e), 0.1 * size / largest);
  const double thickness = std::max(kArrowThickness * length * largest, 0.004 * size);
  Coloured arrows;
  for (const JointWrench& joint : e.last.joints.wrenches) {
    if (joint.negligible) continue;
    BlockSurface arrow;
    const double sign = joint.upper == joint.block_a ? -1.0 : 1.0;
    add_arrow(joint.centre_of_pressure, sign * length * joint.wrench.force, thickness, &arrow);
    arrows.add(arrow, scale.at(joint.wrench.force.norm()));
  }
  const bool through_blocks = !is_vault(e);  // which are see-through
  painter->add_faces(arrows.surface.vertices, arrows.surface.faces, arrows.colours, 1.0, through_blocks);
  Coloured supports, blocks;
  for (size_t b = 0; b < run.blocks.size(); ++b)
    (e.assembly.blocks[b].fixed ? supports : blocks).add(run.blocks[b], bond_colour(e.assembly.blocks[b]));
  supports.paint(painter);
  if (through_blocks) blocks.paint(painter, 0.15);
  const double unit = largest >= 1e6 ? 1e6 : 1e3;
  painter->add_legend(
      fmt::format("Joint force, {} (largest {:.4g})", largest >= 1e6 ? "MN" : "kN", largest / unit), scale,
      unit);
  painter->look(view_direction(e), e.up);
  return true;
}

double size_of(const Pictured& run) {
  double size = 0.0;
  for (const BlockSurface& block : run.blocks)
    for (const Vec3& p : block.vertices) size = std::max(size, p.norm());
  return size;
}

/// The thrust lines, and the half of the vault behind the plane of the first one; a whole arch.
bool draw_thrust(const Pictured& run, Painter* painter) {
  const Evaluation& e = run.e;
  if (!at_rest(e) || e.meridians.empty()) return false;
  const double azimuth = e.meridians.front().thrust.azimuth_deg * EIGEN_PI / 180.0;
  const Vec3 behind = is_vault(e) ? Vec3(-std::sin(azimuth), std::cos(azimuth), 0.0) : Vec3::UnitY();
  for (const MeridianEvaluation& m : e.meridians)
    painter->add_tubes(m.thrust.runs(), kThrust, 0.005 * size_of(run), true);
  paint_blocks(
      run, [&](int b) { return bond_colour(e.assembly.blocks[b]); },
      [&](int b) { return !is_vault(e) || e.assembly.blocks[b].centroid.dot(behind) > 0.0; }, painter);
  std::string names;
  for (const MeridianEvaluation& m : e.meridians) names += (names.empty() ? "" : ", ") + m.thrust.name;
  std::replace(names.begin(), names.end(), '_', ' ');
  painter->add_caption("Thrust lines: " + names);
  painter->look(behind - 0.1 * e.up, e.up);
  return true;
}

bool draw_cracks(const Pictured& run, Painter* painter) {
  const Mesh cracks = cracks_mesh(run.e);
  if (!at_rest(run.e) || cracks.num_cells() == 0) return false;
  paint_blocks(
      run, [&](int b) { return run.e.assembly.blocks[b].fixed ? kSupport : kFlat; }, every_block, painter);
  double widest = 0.0;
  for (const JointWrench& joint : run.e.last.joints.wrenches) widest = std::max(widest, joint.opening);
  std::vector<std::vector<Vec3>> outlines;
  for (int cell = 0; cell < cracks.num_cells(); ++cell) {
    std::vector<Vec3> outline;
    for (int i = cracks.cell_start[cell]; i < cracks.cell_start[cell + 1]; ++i)
      outline.emplace_back(&cracks.points[3 * static_cast<size_t>(cracks.cell_points[i])]);
    outlines.push_back(std::move(outline));
  }
  painter->add_tubes(outlines, kThrust, 0.0025 * size_of(run));
  painter->add_caption(
      fmt::format("{}, open by up to {:.3g} mm", counted(cracks.num_cells(), "open joint"), 1e3 * widest));
  painter->look(view_direction(run.e), run.e.up);
  return true;
}

/// The blocks that exist at one instant, where they are.
Coloured moved_blocks(const Pictured& run, const Frame& moved) {
  constexpr int kNoneHeld = -1;
  const std::vector<bool> left_out = blocks_left_out(run.e.assembly, moved, kNoneHeld);
  Coloured blocks;
  for (size_t b = 0; b < run.blocks.size(); ++b) {
    if (!left_out.empty() && left_out[b]) continue;
    const Block& block = run.e.assembly.blocks[b];
    const Eigen::Vector4d& q = moved.blocks.quaternion_wxyz[b];
    const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
    BlockSurface surface = run.blocks[b];
    for (Vec3& p : surface.vertices) p = moved.blocks.position[b] + turn * (p - block.centroid);
    blocks.add(surface, bond_colour(block));
  }
  return blocks;
}

/// Instants of the motion side by side, to one scale.
bool draw_motion(const Pictured& run, Painter* painter) {
  std::vector<Coloured> instants;
  for (const Frame& moved : run.motion) instants.push_back(moved_blocks(run, moved));
  const double width = 1.0 / static_cast<double>(run.motion.size());
  for (size_t i = 0; i < instants.size(); ++i) {
    painter->new_view(width * static_cast<double>(i), width * static_cast<double>(i + 1));
    instants[i].paint(painter);
    for (const Coloured& other : instants) painter->include(other.surface.vertices);
    painter->add_caption(run.motion[i].label);
    painter->look(view_direction(run.e), run.e.up);
  }
  return !instants.empty();
}

}  // namespace

const std::vector<StandardView>& standard_views() {
  static const std::vector<StandardView> views{
      {"overview", 2000, 1000, draw_overview}, {"inside", 1400, 1000, draw_inside},
      {"cut_open", 1400, 1000, draw_cut_open}, {"exploded", 1400, 1800, draw_exploded},
      {"forces", 1400, 1000, draw_forces},     {"thrust", 1400, 1000, draw_thrust},
      {"cracks", 1400, 1000, draw_cracks},     {"motion", 1000, 700, draw_motion, true}};
  return views;
}

}  // namespace cupola
