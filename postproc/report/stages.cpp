#include "postproc/report/stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/mechanics/cracks.hpp"
#include "postproc/report/answers.hpp"

namespace cupola {
namespace {

using Least = StagedConstruction::Least;
constexpr const char* kStands = "equilibrium";  // verdict of a stage

/// m, mean height of the beds of a course. Its ring sum has none where the stage evaluated holds the course.
double bed_height(const Shell& shell, int ring) {
  double height = 0.0, area = 0.0;
  for (const BedFacet& facet : shell.beds.at(static_cast<size_t>(ring))) {
    if (facet.internal) continue;
    const std::array outline{facet.intrados_a, facet.intrados_b, facet.extrados_b, facet.extrados_a};
    const double share = polygon_area(outline);
    height += share * polygon_centroid(outline).z();
    area += share;
  }
  return area > 0.0 ? height / area : 0.0;
}

/// A curve over the stages; none if it has no values.
std::optional<Figure> curve_over_stages(const std::vector<std::vector<double>>& points, const char* x_label,
                                        const std::string& y_label) {
  if (std::ranges::none_of(points, [](const auto& point) { return std::isfinite(point[1]); }))
    return std::nullopt;
  Figure f;
  f.name = "stages";
  f.width = 900;
  f.height = 480;
  f.commands = plot_style() + data_block("stages", points) +
               fmt::format(
                   "set xlabel '{}'\nset ylabel '{}'\nset "
                   "yrange [0:*]\nunset key\nplot $stages w lp lc rgb '{}' pt 7 ps 0.6 lw 2\n",
                   x_label, y_label, kBlue);
  return f;
}

/// The first stage that does not stand, and the one that needs the most.
struct Notable {
  int standing = 0;
  std::optional<size_t> failing, demanding;
};

Notable notable_stages(const CsvFile& csv, size_t verdict, size_t needs) {
  Notable out;
  for (size_t row = 0; row < csv.rows.size(); ++row) {
    const bool stands = csv.rows[row][verdict] == kStands;
    out.standing += stands;
    if (!stands && !out.failing) out.failing = row;
    if (csv.number(row, needs) > (out.demanding ? csv.number(*out.demanding, needs) : 0.0))
      out.demanding = row;
  }
  return out;
}

/// "4 blocks of course 20 slide", of the rows of one stage in failures.csv; "" without any.
std::string what_moves(const std::optional<CsvFile>& failures, double stage) {
  if (!failures) return "";
  const size_t number = failures->column("stage"), course = failures->column("course");
  const size_t how = failures->column("how");
  std::map<std::pair<std::string, std::string>, int> blocks;  // by course and way
  for (size_t row = 0; row < failures->rows.size(); ++row)
    if (failures->number(row, number) == stage)
      ++blocks[{failures->rows[row][course], failures->rows[row][how]}];
  std::string text;
  for (const auto& [key, count] : blocks) {
    const auto& [ring, way] = key;  // "slides" or "tips"
    text += fmt::format("{}{} of course {} {}", text.empty() ? "" : ", ", counted(count, "block"), ring,
                        count == 1 ? way : way.substr(0, way.size() - 1));
  }
  return text;
}

/// The most of all stages, each with its stage.
std::vector<KeyNumber> largest_of(const std::map<int, StagePeaks>& peaks) {
  std::vector<KeyNumber> out;
  if (peaks.empty()) return out;
  const auto most = [&](double StagePeaks::*value) {
    return *std::ranges::max_element(
        peaks, [&](const auto& a, const auto& b) { return a.second.*value < b.second.*value; });
  };
  if (!std::isnan(peaks.begin()->second.strength_use)) {
    const auto& [pressed, peak] = most(&StagePeaks::pressure);
    const auto& [strained, used] = most(&StagePeaks::strength_use);
    out.push_back(pressure_number(peak.pressure, used.strength_use));
    std::vector<std::string>& details = out.back().details;
    if (strained != pressed) details.front().insert(0, fmt::format("in stage {}, ", strained));
    details.insert(details.begin(), fmt::format("in stage {}", pressed));
  }
  const auto& [stage, peak] = most(&StagePeaks::widest_gap);
  out.push_back(
      peak.widest_gap > 0.0
          ? KeyNumber{kWidestCrack, length_text(peak.widest_gap), {fmt::format("in stage {}", stage)}}
          : KeyNumber{kWidestCrack, "none", {"in none of the stages"}});
  return out;
}

}  // namespace

StagePeaks peaks_of(const FrameEvaluation& stage) {
  StagePeaks peaks;
  for (const JointWrench& joint : stage.joints.wrenches) {
    peaks.pressure = std::max(peaks.pressure, joint.largest_pressure);
    peaks.strength_use = std::fmax(peaks.strength_use, joint.strength_use);  // skips NaN
  }
  for (const Crack& crack : cracks_of(stage.frame.contacts, stage.joints))
    peaks.widest_gap = std::max(peaks.widest_gap, crack.widest_gap);
  return peaks;
}

std::vector<Table::Column> construction_columns(Least least) {
  const std::string property = to_string(least), unit = least == Least::cohesion ? "Pa" : "";
  std::vector<Table::Column> columns{{"stage", "", "stage, counted from 0"},
                                     {"ring", "", "course being laid"},
                                     {"height_m", "m", "mean height of its bed joints"},
                                     {"laid", "", "blocks laid in the stage"},
                                     {"blocks", "", "blocks solved"},
                                     {"verdict", "", "with the mortar of the case"}};
  if (least != Least::none) {
    const std::string end = unit.empty() ? "" : "_" + unit;
    columns.push_back({"least_stands" + end, unit,
                       "least fresh " + property + " with which the stage stands; 0: it needs none"});
    columns.push_back({"least_moves" + end, unit, "fresh " + property + " with which it moves"});
  }
  columns.push_back({"moving", "", least == Least::none ? "what moves" : "what moves with less"});
  columns.push_back(
      {"head_squeeze_m", "m", "closing of the most compressed fresh head joint since it was laid"});
  columns.push_back({"displacement_m", "m", "largest distance of a block from its place in the assembly"});
  columns.push_back(
      {"largest_pressure_Pa", "Pa", "largest pressure on a joint; empty: the stage has no frame"});
  columns.push_back({"strength_use", "", "largest share of its strength that a joint uses"});
  columns.push_back({"widest_crack_m", "m", "widest gap of a crack"});
  return columns;
}

CsvFile from_stages_csv(CsvFile old) {
  std::ranges::replace(old.columns, std::string("critical_stands"), std::string("least_stands"));
  std::ranges::replace(old.columns, std::string("critical_moves"), std::string("least_moves"));
  for (const char* added : {"stage", "laid", "head_squeeze_m", "displacement_m"})
    old.columns.emplace_back(added);
  double before = 0.0;
  for (size_t row = 0; row < old.rows.size(); ++row) {
    const double blocks = old.number(row, old.column("blocks"));
    for (const std::string& cell :
         {std::to_string(row), fmt::format("{}", blocks - before), std::string(), std::string()})
      old.rows[row].push_back(cell);
    before = blocks;
  }
  return old;
}

StageReport report_stages(const Evaluation& e, Least least, const CsvFile& csv,
                          const std::optional<CsvFile>& failures, const std::map<int, StagePeaks>& peaks) {
  const size_t number = csv.column("stage"), ring = csv.column("ring"), laid = csv.column("laid");
  const size_t blocks = csv.column("blocks"), verdict = csv.column("verdict");
  const size_t stands = csv.column("least_stands"), moves = csv.column("least_moves");
  const size_t squeeze = csv.column("head_squeeze_m"), displacement = csv.column("displacement_m");
  const bool cohesion = least == Least::cohesion;
  StageReport out;
  out.table = {"stages", "Construction, stage by stage", construction_columns(least), {}};
  std::vector<std::vector<double>> points;
  for (size_t row = 0; row < csv.rows.size(); ++row) {
    std::vector<Table::Cell>& cells = out.table.rows.emplace_back();
    const auto add_count = [&](size_t column) {
      cells.emplace_back(static_cast<int>(csv.number(row, column)));
    };
    add_count(number);
    add_count(ring);
    cells.emplace_back(bed_height(e.shell, static_cast<int>(csv.number(row, ring))));
    add_count(laid);
    add_count(blocks);
    cells.emplace_back(csv.rows[row][verdict]);
    if (least != Least::none)
      for (const size_t column : {stands, moves}) cells.emplace_back(csv.number(row, column));
    cells.emplace_back(what_moves(failures, csv.number(row, number)));
    for (const size_t column : {squeeze, displacement}) cells.emplace_back(csv.number(row, column));
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const auto found = peaks.find(static_cast<int>(csv.number(row, number)));
    const StagePeaks peak = found == peaks.end() ? StagePeaks{kNone, kNone, kNone} : found->second;
    for (const double value : {peak.pressure, peak.strength_use, peak.widest_gap}) cells.emplace_back(value);
    points.push_back({csv.number(row, number), (cohesion ? 1e-3 : 1.0) * csv.number(row, stands)});
  }
  out.largest = largest_of(peaks);
  const Notable notable = notable_stages(csv, verdict, stands);
  out.standing = notable.standing;
  if (const auto& row = notable.failing ? notable.failing : notable.demanding) {
    const std::string moving = what_moves(failures, csv.number(*row, number));
    out.worst = fmt::format("{}: stage {}, in course {}",
                            notable.failing ? "the first that does not" : "the most demanding",
                            csv.rows[*row][number], csv.rows[*row][ring]);
    if (!moving.empty())
      out.worst += notable.failing ? ", where " + moving
                                   : fmt::format("; if the {} is less, {}", to_string(least), moving);
  }
  out.figure = curve_over_stages(points, "stage", cohesion ? "required cohesion (kPa)" : "required friction");
  if (!out.figure) return out;
  out.figure->title =
      fmt::format("Construction: {} required of the fresh mortar, stage by stage", to_string(least));
  out.figure->caption = fmt::format(
      "The least {} of the joints with fresh mortar with which each stage stands (0: it needs none){}{}.",
      to_string(least), out.worst.empty() ? "" : "; ", out.worst);
  return out;
}

}  // namespace cupola
