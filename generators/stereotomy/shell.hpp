#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"
#include "generators/bond/bond_pattern.hpp"
#include "generators/surface/surface_map.hpp"

namespace cupola {

/// A member: a surface and the bond laid on it.
struct Storey {
  std::string name;
  SurfaceMap surface;
  BondPattern bond;  ///< with the support of a window as blocks of its own, below and beside the courses
  std::vector<std::string> members;  ///< of the bond's labels: wythes and groups of bonders; none: one wythe
  int stage_rings = 0;               ///< of the stage; 0: the complete model
  int refinement = 1;                ///< courses laid for each course of the bond as written
  Eigen::Isometry3d placement =
      Eigen::Isometry3d::Identity();  ///< from the coordinates of the surface to the world; a mirror image
                                      ///< is reflected
  bool stands_on_previous = false;
  bool bears_another = false;
  std::vector<Cut> cuts = {};
  std::string key = {};                     ///< of the member, for messages
  std::vector<std::string> originals = {};  ///< of a copy: `members` of that which it copies
  std::optional<Affine> affine = {};        ///< of a groin vault, after its webs are cut
  std::string beside = {};         ///< member that it touches in the plane of the first of its limits
  std::vector<Plane> limits = {};  ///< of its supports: n.x <= offset, in the coordinates of the surface

  bool is_reflected() const { return placement.linear().determinant() < 0.0; }
  /// Courses of the assembly. Those of a web are counted from both springings up to the crown.
  int num_rings() const {
    if (surface.webs > 0) return (surface.num_rings() + 1) / 2;
    return surface.num_rings() + (surface.key_stone ? 1 : 0);
  }
};

/// The members of a case, in the order of their courses. Throws InputError if surface, bond, openings and
/// window of a member do not fit each other, or if it stands on a bed that is not level.
std::vector<Storey> make_storeys(const Geometry& geometry);

}  // namespace cupola
