#pragma once

#include <span>
#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/tables/column.hpp"
#include "postproc/tables/csv_file.hpp"

namespace cupola {

/// A block in one ring of the unrolled shell, with its forces and utilisations.
struct ShellBox {
  int block = 0, ring = 0;
  double from = 0.0, to = 0.0;  ///< deg of azimuth in a vault, m along a wall, in an arch along y
  double meridional_force = 0.0, hoop_force = 0.0;  ///< N/m, 0 if negligible
  double friction_use = 0.0, kern = 0.0;            ///< NaN without a loaded joint
};

/// Where a figure measures horizontally: along the courses of a wall, over the span of an arch. In the frame
/// of the sheet if that is turned, else of the model.
struct Abscissa {
  Vec3 direction = Vec3::UnitX();  ///< horizontal unit vector, of the world
  Vec3 from = Vec3::Zero();        ///< m
  double of(const Vec3& point) const { return direction.dot(point - from); }
  Abscissa turned() const { return {Vec3::UnitZ().cross(direction), from}; }  ///< towards its left
};
Abscissa abscissa_of(const Shell& shell, const Sheet& sheet);

/// The unrolled shell, or one wythe of it: ring over azimuth, along a wall, or of an arch over y. In the frame
/// of its sheet if that is turned or a vault, else of the model.
struct ShellMap {
  bool vault = false;  ///< azimuths
  int num_rings = 0;   ///< the last ring is num_rings - 1
  std::vector<ShellBox> boxes;
  std::string wythe = {};  ///< its name; "" for a shell without wythes
  int number = 0;          ///< of the wythe, from the inside
  bool arch = false;       ///< along y, across the arch
  int first_ring = 0;      ///< of its sheet
  /// The file names' beginning: "shell", "wall" or "arch". No two are beginnings of each other's.
  std::string table_name() const;
  std::string suffix() const;  ///< of the names of its files: "" or "_" and the wythe
};

/// A block in `rings` rings that lie on each other, where it is equally wide and has the same forces.
struct TallBox {
  ShellBox lowest;
  int rings = 1;
};
std::vector<TallBox> tall_boxes(const ShellMap& map);

const Columns<ShellBox>& shell_columns();

/// The blocks on the beds of the shell, of one map per wythe that has blocks, inside first; no map without
/// rings. A bonder is in the maps of all its wythes. A block that crosses +-180 degrees begins or ends
/// beyond.
std::vector<ShellMap> shell_maps(const Evaluation& evaluation);

/// shell.csv, or wall.csv for a shell without azimuths, arch.csv for an arch; of a wythe with its name behind.
Table shell_table(const ShellMap& map, std::span<const ShellBox> boxes);

/// The maps in the folder of a run, from the lowest sheet upwards; none if it has no rings or no equilibrium.
/// Wythes are named as in the case; in files of before 0.5.3 as the file is.
std::vector<ShellMap> read_shell_maps(const std::string& post_folder);

}  // namespace cupola
