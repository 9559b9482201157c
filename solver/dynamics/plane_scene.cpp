#include "solver/dynamics/plane_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr double kRounding = 1e-9;  // of the size of the scene

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("analysis.plane: the scene is not plane: " + what + "; set analysis.plane: false");
}

/// True if each vertex of the part has a mirror image in the plane y = middle (m).
bool symmetric(const Assembly& assembly, const Part& part, double middle, double tolerance) {
  std::vector<std::array<double, 3>> here, mirrored;
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
    for (const int v : assembly.face(f)) {
      const Vec3& x = assembly.vertices[v];
      const auto rounded = [tolerance](double value) { return std::round(value / tolerance); };
      here.push_back({rounded(x.x()), rounded(x.z()), rounded(x.y() - middle)});
      mirrored.push_back({rounded(x.x()), rounded(x.z()), rounded(middle - x.y())});
    }
  std::sort(here.begin(), here.end());
  std::sort(mirrored.begin(), mirrored.end());
  return here == mirrored;
}

void require_plane_blocks(const Assembly& assembly, double middle, double tolerance) {
  for (const Part& part : assembly.parts)
    if (!symmetric(assembly, part, middle, tolerance))
      refuse(fmt::format("block {} is not symmetric about y = {:g} m", part.block, middle));
}

void require_plane_actions(const PlaneActions& actions, double tolerance) {
  if (actions.loads.gravity.y() != 0.0) refuse("gravity has a component along y");
  for (const PointLoad& load : actions.loads.points)
    if (load.force.y() != 0.0 || std::abs(load.p_BP_B.y()) > tolerance)
      refuse(fmt::format("a load on block {} acts outside the plane", load.block));
  for (const Tie& tie : actions.ties)
    if (std::abs(tie.p_AP_A.y()) > tolerance || std::abs(tie.p_BP_B.y()) > tolerance)
      refuse(
          fmt::format("the tie between blocks {} and {} lies outside the plane", tie.block_a, tie.block_b));
  for (const SupportMotion& motion : actions.support_motions)
    if (motion.displacement.y() != 0.0 || motion.rotation.x() != 0.0 || motion.rotation.z() != 0.0)
      refuse(fmt::format("support {} moves out of the plane", motion.block));
  if (!actions.heat.stays_in_plane()) refuse("a change of temperature grows along y");
}

}  // namespace

void require_plane_scene(const Case& scene, const Assembly& assembly, const PlaneActions& actions) {
  if (scene.contact.method != ContactDetection::Method::face_clipping)
    throw InputError("analysis.plane: requires contact.method: face_clipping");
  double size = 0.0;
  for (const Vec3& x : assembly.vertices) size = std::max(size, (x - assembly.vertices[0]).norm());
  const auto free = std::find_if(assembly.blocks.begin(), assembly.blocks.end(),
                                 [](const Block& block) { return !block.fixed; });
  const double middle = free != assembly.blocks.end() ? free->centroid.y() : 0.0;
  require_plane_blocks(assembly, middle, kRounding * size);
  require_plane_actions(actions, kRounding * size);
}

}  // namespace cupola
