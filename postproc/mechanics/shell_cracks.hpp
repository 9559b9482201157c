#pragma once

#include <vector>

#include "postproc/mechanics/joint_wrenches.hpp"

namespace cupola {

/// Course of a crack over the shell.
enum class CrackCourse : std::uint8_t {
  meridional,  ///< through head joints, from course to course
  parallel,    ///< along the beds of one course
  layers       ///< between layers of the thickness, or without a direction
};
constexpr auto enum_names(CrackCourse) {
  return std::array{"meridional", "parallel", "layers"};
}

/// Joints that are open and follow each other over the shell. Widths are gaps along the normals of the
/// joints.
struct ShellCrack {
  CrackCourse course = CrackCourse::meridional;
  std::vector<int> joints;   ///< into JointWrenches::wrenches, by ring, then by number
  double length = 0.0;       ///< m, of its joints along the shell
  double width = 0.0;        ///< m, widest gap
  double width_inner = 0.0;  ///< m, widest gap at the inner edges of its joints
  double width_outer = 0.0;  ///< m, and at the outer edges
  bool through = false;      ///< some joint is open at its inner and its outer edge
  double rotation = 0.0;     ///< rad, opening towards the extrados positive, of the joint where it is largest
  double slip = 0.0;         ///< m, largest accumulated slip of its joints
  Vec3 start = Vec3::Zero();   ///< m, centre of its first joint
  Vec3 end = Vec3::Zero();     ///< m, centre of its last joint
  Vec3 middle = Vec3::Zero();  ///< m, mean of the centres of its joints, weighted by their widths
  double azimuth = 0.0;        ///< rad, of the middle about the axis of the shell
};

/// The cracks of a frame, the widest first. Joints whose gaps stay below kHairline of the widest are left
/// out. Head joints of two courses follow each other if they end at one point, or near each other on a bed
/// between their blocks; beds of a course if they share a block.
inline constexpr double kHairline = 0.02;
std::vector<ShellCrack> shell_cracks(const Assembly& assembly, const ContactTable& contacts,
                                     const JointWrenches& joints, const std::vector<ShellAxes>& axes);

}  // namespace cupola
