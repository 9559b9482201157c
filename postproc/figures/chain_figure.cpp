#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "postproc/figures/figures.hpp"
#include "postproc/figures/plot_style.hpp"

namespace cupola {
namespace {

/// Azimuth (deg) and tension of the bars of a chain, by azimuth.
std::vector<std::vector<double>> bars_by_azimuth(const Evaluation& e, int chain, double per_newton) {
  const TieTable& ties = e.last.frame.ties;
  std::vector<std::vector<double>> rows;
  for (int i = 0; i < ties.size(); ++i) {
    if (ties.chain[i] != chain) continue;
    const Vec3 middle = 0.5 * (ties.point_a[i] + ties.point_b[i]);
    const double angle = azimuth(e.assembly, ties.block_a[i], ties.block_b[i], middle) * kDegrees;
    rows.push_back({angle < 0.0 ? angle + 360.0 : angle, per_newton * ties.force[i]});
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// True if a chain goes round a closed member; false for tie rods.
bool is_round(const Evaluation& e, int chain) {
  const TieTable& ties = e.last.frame.ties;
  for (int i = 0; i < ties.size(); ++i)
    if (ties.chain[i] == chain) return e.assembly.axis_of(e.assembly.blocks[ties.block_a[i]].ring).closed;
  return false;
}

}  // namespace

bool has_chains_round(const Evaluation& e) {
  for (size_t c = 0; c < e.chains.size(); ++c)
    if (is_round(e, static_cast<int>(c))) return true;
  return false;
}

Figure chain_figure(const Evaluation& e) {
  constexpr std::array kColours{kBlue, kOrange, kGreen, kPurple, kSky};
  double largest = 0.0;
  for (size_t c = 0; c < e.chains.size(); ++c)
    if (is_round(e, static_cast<int>(c))) largest = std::max(largest, e.chains[c].greatest);
  const ForceUnit unit = force_unit(largest);
  Figure f;
  f.name = "chains";
  f.title = "Tension round the chains";
  f.caption =
      "Tension of every bar over the azimuth of its middle. Dashed: the yield force, where it is in view.";
  f.width = 900;
  f.height = 480;
  f.commands = plot_style();
  std::string plots;
  for (size_t c = 0; c < e.chains.size(); ++c) {
    const ChainForces& chain = e.chains[c];
    if (!is_round(e, static_cast<int>(c))) continue;
    const char* colour = kColours[c % kColours.size()];
    const std::string data = fmt::format("chain{}", c);
    const auto rows = bars_by_azimuth(e, static_cast<int>(c), unit.per_newton);
    if (rows.empty()) continue;
    f.commands += data_block(data, rows);
    plots += fmt::format("{}${} w lp lc rgb '{}' pt 7 ps 0.5", plots.empty() ? "plot " : ", ", data, colour);
    plots += curve_label(data, rows.size() - 1, "$1", "$2", chain.name, colour);
    if (std::isfinite(chain.yield_force) && chain.yield_force < 2.0 * largest)
      f.commands += fmt::format("set arrow from 0, first {0} to 360, first {0} nohead dt 2 lc rgb '{1}'\n",
                                unit.per_newton * chain.yield_force, colour);
  }
  f.commands += fmt::format(
      "set xlabel 'azimuth (deg)'\nset ylabel 'tension ({})'\nset xrange [0:360]\nset xtics 45\nset yrange "
      "[0:*]\nset rmargin 14\nunset key\n{}\n",
      unit.name, plots);
  return f;
}

}  // namespace cupola
