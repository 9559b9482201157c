#include "solver/analysis/path_row.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/files/csv_columns.hpp"

namespace cupola {
namespace {

constexpr CsvColumn<PathRow> kPathColumns[] = {
    {"time_s", [](const PathRow& r) { return fmt::format("{:.9g}", r.time); }},
    {"displacement_m", [](const PathRow& r) { return fmt::format("{:.9g}", r.displacement); }},
    {"force_N", [](const PathRow& r) { return fmt::format("{:.9g}", r.force); }},
    {"dissipated_J", [](const PathRow& r) { return fmt::format("{:.9g}", r.dissipated); }},
    {"mean_damage", [](const PathRow& r) { return fmt::format("{:.6g}", r.mean_damage); }},
    {"solves", [](const PathRow& r) { return std::to_string(r.solves); }},
    {"widest_gap_m", [](const PathRow& r) { return fmt::format("{:.9g}", r.widest_gap); }},
};

}  // namespace

std::string path_header() {
  return csv_header(kPathColumns) + "\n";
}

std::string path_line(const PathRow& row) {
  return csv_row(kPathColumns, row) + "\n";
}

Vec3 control_force(const Model& model, const EquilibriumPath& path, const StaticSolution& solution,
                   int block) {
  if (model.free_index[block] != ContactProblem::kFixed) return solution.balance.applied_load;
  Vec3 force = Vec3::Zero();
  const auto add = [&](int a, int b, const Vec3& on_b) {
    if (a == block) force += on_b;
    if (b == block) force -= on_b;
  };
  for (size_t i = 0; i < path.contacts().points.size(); ++i) {
    const Contact& contact = path.contacts().points[i];
    add(contact.block_a, contact.block_b, solution.forces.contacts[i]);
  }
  for (size_t k = 0; k < model.ties.size(); ++k) {
    const Tie& tie = model.ties[k];
    if (tie.is_restraint()) continue;  // a force of the ground
    const State& start = path.start();
    add(tie.block_a, tie.block_b,
        solution.forces.ties[k] * tie_geometry(tie, start.poses, start.ground).normal);
  }
  return force;
}

double widest_gap(const ContactTable& contacts) {
  double widest = 0.0, largest = 0.0;
  for (const double force : contacts.normal_force) largest = std::max(largest, force);
  for (int i = 0; i < contacts.size(); ++i) {
    // An open point may press by rounding.
    if (contacts.normal_force[i] > kNegligibleShare * largest) continue;
    widest = std::max(widest, contacts.crack_opening.empty() ? contacts.gap[i] : contacts.crack_opening[i]);
  }
  return widest;
}

double mean_damage(const ContactTable& contacts) {
  double damage = 0.0, area = 0.0;
  for (int i = 0; i < contacts.size() && !contacts.damage.empty(); ++i) {
    if (std::isnan(contacts.damage[i])) continue;  // nothing to lose
    damage += contacts.area[i] * contacts.damage[i];
    area += contacts.area[i];
  }
  return area > 0.0 ? damage / area : 0.0;
}

}  // namespace cupola
