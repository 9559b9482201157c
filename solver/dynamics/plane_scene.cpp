#include "solver/dynamics/plane_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr double kRounding = 1e-9;                                       // of the size of the scene
constexpr double kUlps = 16.0 * std::numeric_limits<double>::epsilon();  // of the coordinates

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("analysis.plane: the scene is not plane: " + what + "; set analysis.plane: false");
}

/// True if each vertex of the part has a mirror image in the plane y = middle (m).
bool symmetric(const Assembly& assembly, const Part& part, double middle, double tolerance) {
  std::vector<Vec3> corners;
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
    for (const int v : assembly.face(f)) corners.push_back(assembly.vertices[v]);
  return std::ranges::all_of(corners, [&](const Vec3& x) {
    const Vec3 image(x.x(), 2.0 * middle - x.y(), x.z());
    return std::ranges::any_of(
        corners, [&](const Vec3& other) { return (other - image).cwiseAbs().maxCoeff() <= tolerance; });
  });
}

void require_plane_blocks(const Assembly& assembly, double middle, double tolerance) {
  for (const Part& part : assembly.parts)
    if (!symmetric(assembly, part, middle, tolerance))
      refuse(fmt::format("block {} is not symmetric about y = {:.10g} m", part.block, middle));
}

void require_plane_actions(const PlaneActions& actions, double tolerance) {
  if (actions.loads.gravity.y() != 0.0 || actions.loads.pull.y() != 0.0)
    refuse("gravity has a component along y");
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
  double tolerance = 0.0;
  for (const Vec3& x : assembly.vertices)
    tolerance = std::max({tolerance, kRounding * (x - assembly.vertices[0]).norm(), kUlps * x.norm()});
  const auto free = std::find_if(assembly.blocks.begin(), assembly.blocks.end(),
                                 [](const Block& block) { return !block.fixed; });
  const double middle = free != assembly.blocks.end() ? free->centroid.y() : 0.0;
  require_plane_blocks(assembly, middle, tolerance);
  require_plane_actions(actions, tolerance);
}

}  // namespace cupola
