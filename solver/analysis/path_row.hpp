#pragma once

#include <string>

#include "assembly/model/results.hpp"
#include "solver/analysis/statics/equilibrium_path.hpp"

namespace cupola {

/// An equilibrium of a path: a row of path.csv. Its force is that of control_force(), of a free block less
/// that at time 0.
struct PathRow {
  double time, displacement, force, dissipated, mean_damage;
  int solves;
  double widest_gap;
};

/// The first line of path.csv, and one of its rows.
std::string path_header();
std::string path_line(const PathRow& row);

/// The force that a support exerts on the blocks by contacts and ties, N, or the loads on all blocks if the
/// control block is free. `path`: at the end of the step that `solution` solved.
Vec3 control_force(const Model& model, const EquilibriumPath& path, const StaticSolution& solution,
                   int block);

/// m, of the points of open joints; 0 if all are closed.
double widest_gap(const ContactTable& contacts);

/// Mean over the area of the joints that have something to lose; 0 without such joints.
double mean_damage(const ContactTable& contacts);

}  // namespace cupola
