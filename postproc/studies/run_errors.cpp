#include "postproc/studies/run_errors.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {
namespace {

/// |F|^2 + |M|^2 / area, N^2: the lever arm that turns a moment into a force is the side of a square joint.
double squared_size(const Wrench& wrench, double area) {
  return wrench.force.squaredNorm() + (area > 0.0 ? wrench.moment.squaredNorm() / area : 0.0);
}

Wrench difference(const Wrench& run, const Wrench& reference) {
  const Wrench moved = moved_to(run, reference.point);
  return {reference.point, moved.force - reference.force, moved.moment - reference.moment};
}

Vec3 vector_at(const CsvFile& csv, size_t row, size_t first_column) {
  return {csv.number(row, first_column), csv.number(row, first_column + 1),
          csv.number(row, first_column + 2)};
}

}  // namespace

RunForces read_forces(RunFiles& run) {
  RunForces forces;
  const CsvFile& joints = run.table("joints");
  const size_t a = joints.column("block_a"), b = joints.column("block_b"), kind = joints.column("kind");
  const size_t point = joints.column("x_m"), force = joints.column("force_x_N");
  const size_t moment = joints.column("moment_x_Nm"), area = joints.column("area_m2");
  for (size_t i = 0; i < joints.rows.size(); ++i) {
    const std::string& name = joints.rows[i][kind];
    if (name != "bed" && name != "base") continue;
    forces.beds[{static_cast<int>(joints.number(i, a)), static_cast<int>(joints.number(i, b)), name}] = {
        vector_at(joints, i, point), vector_at(joints, i, force), vector_at(joints, i, moment)};
    forces.mean_area += joints.number(i, area);
  }
  if (!forces.beds.empty()) forces.mean_area /= static_cast<double>(forces.beds.size());
  for (const std::string& name : run.table_names("thrust_")) {
    const CsvFile& line = run.table(name);
    const size_t bed = line.column("bed"), position = line.column("position");
    for (size_t i = 0; i < line.rows.size(); ++i)
      forces.thrust[name][static_cast<int>(line.number(i, bed))] = line.number(i, position);
  }
  return forces;
}

RunForces extrapolated(const RunForces& fine, const RunForces& coarse) {
  RunForces out = fine;
  for (auto& [id, wrench] : out.beds) {
    wrench.force *= 2.0;
    wrench.moment *= 2.0;
  }
  for (const auto& [id, wrench] : coarse.beds) {
    const auto [entry, is_new] = out.beds.try_emplace(id, Wrench{wrench.point, Vec3::Zero(), Vec3::Zero()});
    Wrench& sum = entry->second;
    const Wrench moved = moved_to(wrench, sum.point);
    sum.force -= moved.force;
    sum.moment -= moved.moment;
  }
  for (auto& [meridian, line] : out.thrust)
    if (const auto other = coarse.thrust.find(meridian); other != coarse.thrust.end())
      for (auto& [bed, position] : line)
        if (const auto same = other->second.find(bed); same != other->second.end())
          position = 2.0 * position - same->second;
  return out;
}

ForceErrors compare_forces(const RunForces& reference, const RunForces& run) {
  ForceErrors errors;
  double sum_error = 0.0, sum_size = 0.0, worst = 0.0;
  const auto add_error = [&](const Wrench& error) {
    const double e2 = squared_size(error, reference.mean_area);
    sum_error += e2;
    worst = std::max(worst, e2);
  };
  for (const auto& [id, wrench] : reference.beds) {
    sum_size += squared_size(wrench, reference.mean_area);
    const auto same = run.beds.find(id);
    // A joint that the run lacks counts as unloaded.
    add_error(same != run.beds.end() ? difference(same->second, wrench) : wrench);
  }
  for (const auto& [id, wrench] : run.beds)
    if (!reference.beds.contains(id)) add_error(wrench);
  if (sum_size > 0.0) {
    errors.wrench_rms = std::sqrt(sum_error / sum_size);
    errors.wrench_worst = std::sqrt(worst * static_cast<double>(reference.beds.size()) / sum_size);
  }
  for (const auto& [meridian, line] : reference.thrust) {
    const auto other = run.thrust.find(meridian);
    if (other == run.thrust.end()) continue;
    for (const auto& [bed, position] : line)
      if (const auto same = other->second.find(bed); same != other->second.end())
        errors.thrust_line = std::max(errors.thrust_line, std::abs(same->second - position));
  }
  return errors;
}

}  // namespace cupola
